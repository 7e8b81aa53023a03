// `skein bench --view`: measures what it costs to watch a run on its live page. Flies pairs of equal runs: a browser
// shows the page of one of them. Compares the CPU times of the two fleets, and measures the work of the browser.
// docs/performance.md has results.
#pragma once

#include <ostream>
#include <vector>

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// Two runs of the same flight. In both runs, the station serves the page.
struct WatchedPair {
  Json unseen;   ///< result.json of the run without a browser
  Json watched;  ///< result.json of the run with a browser that shows the page
  Json page;     ///< work of that browser for the page, as bench/view/watched_run.mjs prints it
};

/// Summarises the pairs. @returns {"pairs", "cpu_ratio", "first_picture_ms", "script_ms", "thread_ms", "draw_calls",
/// "pictures"}. `pairs` is the number of pairs. Each other key has a figure() (report.hpp) over the pairs, or null if
/// no pair has a value. `cpu_ratio` is the CPU time of the fleet that a browser watches, divided by that of the other
/// one, both from the first step to the last. The values of the other keys are those of WatchedPair::page.
Json watching_entry(const std::vector<WatchedPair>& pairs);

/// Prints a watching_entry() as a table, with the target of each figure.
void print_watching(std::ostream& out, const Json& entry);

/// Flies the pairs at the default speed of watched runs (view::kUsualSpeed). Needs the source tree with
/// web/node_modules, Node.js and Chromium.
/// @returns kExitDone; kExitProcessFailed if a run or its browser failed.
/// @throws InputError before the first flight if one of these is missing; Interrupted after Ctrl-C.
int bench_watching(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
