// The tables of a study as CSV (RFC 4180; a cell is empty if its value is not known). docs/studies.md
// lists the columns. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "cli/study/pairs.hpp"

namespace skein::cli {

/// A line for each flight, in the order of the plan.
std::string flights_csv(const Study& study);
/// A line for each pair, in the given order. The scenario's cell is empty for pairs over all scenarios.
std::string pairs_csv(const Study& study, const std::vector<PlannerPair>& pairs);
/// A line for each scenario and planner: median, min and max over the seeds.
std::string summary_csv(const Study& study);
/// For a contest. A line for each planner, by rank: its total in each test, and the max, median and worst of these.
std::string totals_csv(const Study& study);

}  // namespace skein::cli
