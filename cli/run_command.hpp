// `skein run`: one flight. The struct of its options is in run/run_options.hpp, because studies, hunts and repeated
// runs fill it, too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "process/program.hpp"  // exit codes
#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Adds the command `run`, whose options CLI11 parses into the second argument.
void add_run(CLI::App& app, RunOptions& run);
/// Checks and completes the parsed options. @param arguments  the whole command line
/// @throws InputError for options that do not go together.
void finish_run(RunOptions& run, const std::vector<std::string>& arguments);

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

}  // namespace skein::cli
