// The tables of a study as CSV (RFC 4180; empty cells where nobody could tell). docs/how-to-compare-planners.md lists
// the columns. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "cli/study/pairs.hpp"

namespace skein::cli {

/// A line a flight, in the order in which they were planned.
std::string flights_csv(const Study& study);
/// A line a figure and pair of planners in a scenario, then over all of them, for which the scenario's cell is empty.
std::string pairs_csv(const Study& study, const std::vector<PlannerPair>& pairs);
/// A line a scenario and planner: median, min and max over the seeds.
std::string summary_csv(const Study& study);
/// Of a contest, a line a planner in order of rank: totals a test, and what ranks them.
std::string totals_csv(const Study& study);

}  // namespace skein::cli
