// `skein bench`: measures speed, memory, and where the time goes. One call measures everything, with the same programs
// that a user's run starts. bench/report.hpp computes the figures, docs/performance.md explains them.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Flies and measures, prints the tables, writes --json. Takes minutes, with --quick well below one.
/// @returns kExitDone when every run reached its end, whether or not it meets the targets; else kExitProcessFailed, or
///   kExitInterrupted. @throws InputError before anything has started.
int run_bench(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
