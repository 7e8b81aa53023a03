// What the commands of cli/command.hpp do; the other commands have headers of their own, such as cli/scene_command.hpp.
// Each function returns the exit code (process/program.hpp), and throws InputError for invalid input and Interrupted
// after Ctrl-C, if it can meet them.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "process/program.hpp"

namespace skein::cli {

/// `skein run`, from the options to result.json: validates the options, starts the fleet, monitors it until it ends,
/// and writes the result. @throws InputError before the fleet's programs have started; Interrupted if the user presses
///   Ctrl-C before the flight.
int run_fleet(const RunOptions& options, const Console& console);

/// How a run ended, and where its results are.
struct RunEnd {
  int code = 0;                    ///< exit code, as of run_fleet()
  std::filesystem::path dir = {};  ///< empty: the options asked for something else than a flight
};

/// As run_fleet(), for a caller that does not know which free folder the run takes.
RunEnd fly_fleet(const RunOptions& options, const Console& console);

/// `skein compose`: writes a docker-compose file for a fleet in containers, or flies that fleet at once.
/// @throws InputError; std::runtime_error when the containers cannot be created.
int compose_fleet(const ComposeOptions& options, const Console& console);

/// `skein keys`: makes the keys of a secured fleet that is started by hand or by other tools.
/// @throws InputError when the folder exists already or cannot be created; std::system_error when a key cannot be
///   written.
int make_keys(const KeysOptions& options, const Console& console);

/// `skein replay`: shows a finished run, or two runs on one clock, on the same page that follows a live run. Serves the
/// page until the user interrupts, or writes it to a file.
/// @throws InputError when a folder holds no result, two runs have no scene in common, no page can be served, or the
///   requested file cannot be written; Interrupted while a film is made.
int replay_run(const ReplayOptions& options, const Console& console);

/// `skein contest` and `skein compare`: flies the flights that are still missing, then writes report.html, flights.csv,
/// summary.csv, pairs.csv, table.tex, figures/*.svg and, for a contest, totals.csv; also after Ctrl-C and when flights
/// have failed. @returns kExitProcessFailed when a flight failed, kExitCheckFailed when one does not meet a
///   requirement, kExitInterrupted after Ctrl-C. @throws InputError before anything flies; Interrupted while the input
///   is checked.
int run_study(const StudyOptions& options, const Console& console);

/// `skein test`: runs the test suite of this build, or with --faults the user's fault tests; the summary is the last
/// line. @throws InputError when this build has no tests, or for invalid options.
int run_tests(const TestOptions& options, const Console& console);

/// `skein test --faults`: prints one line per test, PASS or FAIL, with what does not hold below it; the last line is 'N
/// passed, N failed'. All files are validated before anything flies. A run without faults that several tests compare
/// with is flown once. With --junit the report exists from the start and grows with each test, so after Ctrl-C it holds
/// the tests that were flown. @throws InputError when a file is wrong; Interrupted.
int run_fault_tests(const TestOptions& options, const Console& console);

/// `skein hunt`: searches for faults that break a property, and writes a capsule for each find.
/// @returns kExitDone when nothing was found, kExitCheckFailed with finds. @throws InputError, Interrupted.
int run_hunt(const HuntOptions& options, const Console& console);

/// `skein bench`: flies and measures speed, memory, and where the time goes, with the same programs that a user's run
/// starts; prints the tables and writes --json. Takes minutes, with --quick well below one. docs/performance.md
/// explains the figures. @returns kExitDone when every run reached its end, whether or not it meets the targets; else
///   kExitProcessFailed, or kExitInterrupted. @throws InputError before anything has started.
int run_bench(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
