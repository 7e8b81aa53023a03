#include "run/memory_need.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string>

#include "core/types.hpp"
#include "process/host/memory.hpp"

namespace skein::cli {

std::uint64_t memory_need(const FleetPlan& plan) {
  const auto flies = [&](const UavPlanner& planner) { return takes_part(plan, planner.uav); };
  const auto uavs = static_cast<std::size_t>(std::ranges::count_if(plan.planners, flies));
  return plan.options.one_process ? one_process_memory(uavs) : fleet_memory(uavs);
}

void check_memory(const FleetPlan& plan, const std::optional<std::uint64_t>& left) {
  const std::string shortage = memory_shortage(memory_need(plan), left);
  if (plan.options.place.at || shortage.empty()) return;
  throw InputError(fmt::format("a fleet of {} UAVs {}: end other programs, or fly fewer UAVs (--uavs){}",
                               plan.scenario.fleet.size(), shortage,
                               plan.options.one_process ? "" : ", or in one process (--one-process)"));
}

}  // namespace skein::cli
