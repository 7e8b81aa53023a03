#include "run/free_nodes.hpp"

#include "core/planners/free_nodes.hpp"
#include "core/types.hpp"

namespace skein::cli {

std::vector<std::string> uavs_of_free_nodes(const std::vector<UavPlanner>& planners) {
  std::vector<std::string> uavs;
  for (const UavPlanner& planner : planners) {
    if (planner.spec == kFreeNodes) uavs.push_back(planner.uav);
  }
  return uavs;
}

void check_free_nodes(const std::vector<UavPlanner>& planners, const std::string& clock) {
  const std::vector<std::string> uavs = uavs_of_free_nodes(planners);
  if (uavs.empty() || clock.starts_with("realtime")) return;
  throw InputError("--planner " + uavs.front() +
                   "=ros: nothing waits for free-running ROS 2 nodes, so they need --clock realtime; to have a node "
                   "take part in the lock-step, write " +
                   uavs.front() + "=ros:PACKAGE/EXECUTABLE (docs/how-to-ros2.md)");
}

}  // namespace skein::cli
