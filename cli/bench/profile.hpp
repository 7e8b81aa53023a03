// `skein bench --profile`: the cost of each stage of an exchange, for each planner, by the size of the fleet, and how
// it grows. The cost is CPU time, on which other load of the machine has little effect. The arithmetic is pure.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// The cost of an exchange of a flight in one process: `uavs`, `planner`, `stages`, by the names of work_of(), and
/// `parts` of the stage `agents`, by the names that planners and agents give them (result.json's `planner_parts`). Each
/// has its CPU time `ms` and `us_a_uav`. Also `counts` per exchange: scans, exposures and radio messages that arrived.
/// All are medians over `results`.
Json profile_entry(const std::string& planner, std::size_t uavs, const std::vector<Json>& results);

/// The fit of cost = factor * uavs^exponent that is best in logarithms (least squares). at() extrapolates the cost.
/// growth_of() returns nullopt if fewer than two sizes have a cost.
struct Growth {
  double exponent = 0.0, factor = 0.0;
  double at(double uavs) const;
};
std::optional<Growth> growth_of(const std::vector<std::pair<double, double>>& cost_by_uavs);

/// From the entries of one planner: `exponent` and `ms_at_1000` (UAVs) by stage and by part, and `first_limit`, the
/// stage that costs most with 1000 UAVs. @param entries  of profile_entry(), any order.
Json profile_growth(const std::vector<Json>& entries);

/// Prints for each planner the costs of stages, for each UAV and of the whole fleet, and of parts, by the size of the
/// fleet, and how they grow. @param report  has `profile`, the entries, and `growth` by planner.
void print_profile(std::ostream& out, const Json& report);

/// Flies all planners of the flight core in fleets of each size, in the scenario `district`, in one process and on one
/// thread. A line says which sizes do not fit into the host's memory, or are too large for a planner; these are not
/// flown. @returns as run_bench(). @throws InputError if no fleet could fly.
int bench_profile(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
