// `skein diff`: where two runs part, and in what.
#pragma once

#include "cli/command.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Compares digests step by step, what was said by radio and as commands (of runs with recordings), the results, and
/// the tables of captures, events, scores and flights.
/// @returns the exit code: 0 the same, 1 different. @throws InputError when a folder holds no run, or a file of it is
///   damaged.
int diff_runs(const DiffOptions& options, const Console& console);

}  // namespace skein::cli
