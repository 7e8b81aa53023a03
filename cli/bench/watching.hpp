// `skein bench --view`: compares the CPU time of a run whose live page a browser shows with that of a run without a
// browser, and measures what the page costs the browser. docs/performance.md has the results.
#pragma once

#include <ostream>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// Two runs of the same flight. Both runs serve the page.
struct WatchedPair {
  Json unseen;   ///< result.json of the run whose page no browser showed
  Json watched;  ///< result.json of the run whose page a browser showed
  Json page;     ///< costs of the page in that browser (bench/view/watched_run.mjs)
};

/// {"pairs", "cpu_ratio", "first_picture_ms", "script_ms", "thread_ms", "draw_calls", "pictures"}: the number of pairs,
/// and a figure() over the pairs (report.hpp) for each other key; null if no pair has the value. `cpu_ratio` is the
/// fleet's CPU time with a browser, from the first step to the last, divided by that without a browser.
Json watching_entry(const std::vector<WatchedPair>& pairs);

/// Prints the figures next to their targets.
void print_watching(std::ostream& out, const Json& entry);

/// Flies the pairs at the default speed of a watched run. Needs the source tree with web/node_modules, Node.js and
/// Chromium. @returns kExitDone; kExitProcessFailed when a flight failed.
/// @throws InputError before the first flight if one of these is missing; Interrupted after Ctrl-C.
int bench_watching(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
