// `skein run`: from the options to result.json.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "process/program.hpp"

namespace skein::cli {

/// Validates the options, starts the fleet, monitors it until it ends, and writes the result.
/// @returns the exit code (process/program.hpp). @throws InputError for invalid input, before the fleet's programs have
///   started; Interrupted if the user presses Ctrl-C before the flight.
int run_fleet(const RunOptions& options, const Console& console);

}  // namespace skein::cli
