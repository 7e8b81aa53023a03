// `skein bench --view`: what it costs a run that a page follows it, and what the page itself costs. docs/performance.md
// has the table.
#pragma once

#include <ostream>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// The same flight twice; the page is served both times.
struct WatchedPair {
  Json unseen;   ///< result.json; no browser showed the page
  Json watched;  ///< result.json; a browser showed the page
  Json page;     ///< costs of the page (bench/view/watched_run.mjs)
};

/// {"pairs", "cpu_ratio", "first_picture_ms", "script_ms", "thread_ms", "draw_calls", "pictures"}: figures over the
/// pairs (report.hpp); null: no pair has such a value. `cpu_ratio` is of the fleets' CPU time, from first step to last.
Json watching_entry(const std::vector<WatchedPair>& pairs);

/// Prints the figures beside their targets.
void print_watching(std::ostream& out, const Json& entry);

/// Flies pairs at the usual speed of a watched run. Needs the source tree with web/node_modules, Node.js and Chromium.
/// @returns as bench_sensing(). @throws InputError if any of these is missing, before anything flies; Interrupted.
int bench_watching(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
