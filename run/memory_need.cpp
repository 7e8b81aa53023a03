#include "run/memory_need.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/types.hpp"
#include "process/host/memory.hpp"

namespace skein::cli {
namespace {

double megabytes(std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); }

}  // namespace

std::uint64_t memory_need(const FleetPlan& plan) {
  const auto flies = [&](const UavPlanner& planner) { return takes_part(plan, planner.uav); };
  const auto uavs = static_cast<std::size_t>(std::ranges::count_if(plan.planners, flies));
  return plan.options.one_process ? one_process_memory(uavs) : fleet_memory(uavs);
}

void check_memory(const FleetPlan& plan, const std::optional<std::uint64_t>& left) {
  const std::uint64_t need = memory_need(plan);
  if (!left || plan.options.place.at || need <= *left) return;
  throw InputError(
      fmt::format("a fleet of {} UAVs needs about {:.0f} MB of memory, and this host has {:.0f} MB left: end other "
                  "programs, or fly "
                  "fewer UAVs (--uavs){}",
                  plan.scenario.fleet.size(), megabytes(need), megabytes(*left),
                  plan.options.one_process ? "" : ", or in one process (--one-process)"));
}

}  // namespace skein::cli
