// `skein bench --view`: what a page costs that follows a run, and what it takes itself. docs/performance.md has the
// table.
#pragma once

#include <ostream>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// The same flight twice, served both times.
struct WatchedPair {
  Json unseen;   ///< result.json; nobody looked
  Json watched;  ///< result.json; a browser showed the page
  Json page;     ///< what the page took (bench/view/watched_run.mjs)
};

/// {"pairs", "cpu_ratio", "first_picture_ms", "script_ms", "thread_ms", "draw_calls", "pictures"}: figures over the
/// pairs (report.hpp); what no pair has is null. `cpu_ratio` is that of the fleets' CPU time from first step to last.
Json watching_entry(const std::vector<WatchedPair>& pairs);

/// The figures beside their targets.
void print_watching(std::ostream& out, const Json& entry);

/// Flies pairs at the usual speed of a watched run. Needs the source tree with web/node_modules, Node.js and Chromium.
/// @returns as bench_sensing(). @throws InputError when something of that is missing, before it begins.
int bench_watching(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
