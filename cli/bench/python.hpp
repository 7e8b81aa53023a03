// `skein bench --python`: the cost of a planner in Python compared with the same planner in C++, and the cost of fleets
// that a Python program steps, resets and copies. docs/performance.md has the tables.
#pragma once

#include <ostream>
#include <vector>

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// One flight twice: with the planner `hover` in C++, and with the `hover` in Python of python/examples.
struct LanguagePair {
  Json cpp, python;  ///< result.json
};

/// @returns {"pairs", "speed_cpu", "speed_clock"}: the number of pairs, and figures over the pairs (report.hpp) of the
///   ratio speed with Python / speed with C++, by the fleet's CPU time and by the clock; null where there is none.
Json language_pairs_entry(const std::vector<LanguagePair>& pairs);

/// @param planners  results of language_pairs_entry(), under the keys "one process" and "over DDS".
/// @param stepping  output of python/bench/stepping.py: lists of values by figure. A missing figure gets no row.
/// @returns rows: {"name", "figure", "digits", "kind" ("at_least" or "at_most"), "target" and "met"}; the last two are
///   null for a row without a target.
Json python_rows(const Json& planners, const Json& stepping);

/// Prints a table: one line per row, with its target.
void print_python(std::ostream& out, const Json& rows);

/// Flies pairs, then runs stepping.py, which keeps to one core. @returns as bench_sensing(). @throws InputError when
/// the source tree or Python is missing, before anything is measured.
int bench_python(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
