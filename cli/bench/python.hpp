// `skein bench --python`: what planners in Python cost beside the same planner in C++, and what fleets cost that a
// Python program steps, resets and copies. docs/performance.md has the tables.
#pragma once

#include <ostream>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// The same flight with the planner `hover` of C++ and with that of python/examples.
struct LanguagePair {
  Json cpp, python;  ///< result.json
};

/// {"pairs", "speed_cpu", "speed_clock"}: figures over the pairs (report.hpp) of the real-time factor with Python over
/// that with C++, by the fleet's CPU time and by the clock; null where no pair has one.
Json language_pairs_entry(const std::vector<LanguagePair>& pairs);

/// @param planners  of language_pairs_entry(), by "one process" and "over DDS".
/// @param stepping  what python/bench/stepping.py wrote: lists of values by figure. What is missing gets no row.
/// @returns rows: {"name", "figure", "digits", "kind" ("at_least" or "at_most"), "target" and "met", the last two null
///   where nothing is asked for}.
Json python_rows(const Json& planners, const Json& stepping);

/// The rows beside their targets.
void print_python(std::ostream& out, const Json& rows);

/// Flies pairs and runs stepping.py, on one core. @returns as bench_sensing(). @throws InputError when the source tree
/// or Python is missing, before it begins.
int bench_python(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
