// `skein run`: from the options to result.json.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "process/program.hpp"

namespace skein::cli {

/// Validates, starts the fleet, watches it to its end, writes the result.
/// @returns the exit code (process/program.hpp). @throws InputError before anything has started when the input is
/// wrong.
int run_fleet(const RunOptions& options, const Console& console);

}  // namespace skein::cli
