// `skein bench`.
#pragma once

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Adds the command `bench`, whose options CLI11 parses into the second argument.
void add_bench(CLI::App& app, BenchOptions& bench);

/// `skein bench`: flies and measures speed, memory, and where the time goes, with the same programs that a user's run
/// starts; prints the tables and writes --json. Takes minutes, with --quick well below one. docs/performance.md
/// explains the figures. @returns kExitDone when every run reached its end, whether or not it meets the targets; else
///   kExitProcessFailed, or kExitInterrupted. @throws InputError before anything has started.
int run_bench(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
