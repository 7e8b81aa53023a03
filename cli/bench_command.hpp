// `skein bench`: how fast, how large, and where the time goes. Everything is measured in this one call, with the
// programs of a user's run; the figures' arithmetic is in bench/report.hpp, what they mean in docs/performance.md.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Flies and measures, prints the tables, writes --json. Takes minutes, with --quick well below one.
/// @returns kExitDone when every run went to its end, whatever the targets say; kExitProcessFailed otherwise;
///   kExitInterrupted. @throws InputError before anything has started.
int run_bench(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
