// `skein bench --planners`: every planner flies a fixed set of scenes; its scores are shown beside those of a table.
#pragma once

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Flies, in runs/bench-planners, what these programs have not flown yet; prints the comparison, and writes the table
/// to --write. Takes about ten minutes, with --quick one. @returns kExitDone; kExitProcessFailed when a flight failed;
/// kExitInterrupted. @throws InputError when the table cannot be read.
int bench_planners(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
