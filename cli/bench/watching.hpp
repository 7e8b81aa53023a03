// `skein bench --view`: flies pairs of runs, one with its live page open in a browser, and one without a browser.
// Compares the CPU times of the two runs, and measures what the page costs the browser. docs/performance.md has the
// results.
#pragma once

#include <ostream>
#include <vector>

#include "cli/bench_command.hpp"
#include "cli/console.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// Two runs of the same flight. Both runs serve the page.
struct WatchedPair {
  Json unseen;   ///< result.json of the run whose page no browser showed
  Json watched;  ///< result.json of the run whose page a browser showed
  Json page;     ///< costs of the page in that browser (bench/view/watched_run.mjs)
};

/// {"pairs", "cpu_ratio", "first_picture_ms", "script_ms", "thread_ms", "draw_calls", "pictures"}: the number of pairs,
/// and for each other key the figure() (report.hpp) of the pairs' values, or null if no pair has a value.
/// `cpu_ratio` is the fleet's CPU time with a browser, from the first step to the last, divided by that without one.
Json watching_entry(const std::vector<WatchedPair>& pairs);

/// Prints the figures next to their targets.
void print_watching(std::ostream& out, const Json& entry);

/// Flies the pairs at the default speed of a watched run. Needs the source tree with web/node_modules, Node.js and
/// Chromium. @returns kExitDone; kExitProcessFailed when a flight failed.
/// @throws InputError before the first flight if one of these is missing; Interrupted after Ctrl-C.
int bench_watching(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
