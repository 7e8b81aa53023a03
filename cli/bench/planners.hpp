// `skein bench --planners`: every planner flies a fixed set of scenes; its scores are shown beside those of a table.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Flies what has not been flown yet with these programs, in runs/bench-planners, prints the comparison, and writes
/// --write. Takes some ten minutes, with --quick one. @returns kExitDone; kExitProcessFailed when a flight failed;
/// kExitInterrupted. @throws InputError when the table cannot be read.
int bench_planners(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
