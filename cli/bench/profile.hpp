// `skein bench --profile`: what each stage of an exchange and each planner costs by the size of the fleet, and how that
// grows. By CPU time, so that a busy machine changes little. The arithmetic is pure.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// What an exchange of a flight in one process costs: `uavs`, `planner`, and `stages`, by the names of work_of(), each
/// with `ms` and `us_a_uav`, the median over `results` [CPU time]. Also `counts` of an exchange: scans, exposures and
/// messages that arrived by radio.
Json profile_entry(const std::string& planner, std::size_t uavs, const std::vector<Json>& results);

/// The exponent p of cost = a uavs^p that fits best in logarithms, and what it says for another size. nullopt where
/// there are not two sizes with a cost.
struct Growth {
  double exponent = 0.0, factor = 0.0;
  double at(double uavs) const;
};
std::optional<Growth> growth_of(const std::vector<std::pair<double, double>>& cost_by_uavs);

/// From the entries of one planner: by stage `exponent` and `ms_at_1000`, and `first_limit`, the stage that costs most
/// there. @param entries  of profile_entry(), any order.
Json profile_growth(const std::vector<Json>& entries);

/// @param report  `profile`: entries, and `growth` by planner.
void print_profile(std::ostream& out, const Json& report);

/// Flies all planners of the flight core in fleets of each size, in one process and on one thread. @returns as
/// run_bench().
int bench_profile(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
