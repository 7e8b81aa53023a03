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

/// `skein contest` and `skein compare`: flies the flights that are still missing, then writes report.html, flights.csv,
/// summary.csv, pairs.csv, table.tex, figures/*.svg and, for a contest, totals.csv; also after Ctrl-C and when flights
/// have failed. @returns kExitProcessFailed when a flight failed, kExitCheckFailed when one does not meet a
///   requirement, kExitInterrupted after Ctrl-C. @throws InputError before anything flies; Interrupted while the input
///   is checked.
int run_study(const StudyOptions& options, const Console& console);

/// `skein hunt`: searches for faults that break a property, and writes a capsule for each find.
/// @returns kExitDone when nothing was found, kExitCheckFailed with finds. @throws InputError, Interrupted.
int run_hunt(const HuntOptions& options, const Console& console);

}  // namespace skein::cli
