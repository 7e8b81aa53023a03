// UAVs that ROS 2 nodes fly in real time, outside of the lock-step: `--clock realtime --planner UAV=ros`
// (docs/how-to-ros2.md).   Pure.
#pragma once

#include <string>
#include <vector>

#include "core/planners/uav_planner.hpp"

namespace skein::cli {

/// The names of those UAVs, in the order of the planners.
std::vector<std::string> uavs_of_free_nodes(const std::vector<UavPlanner>& planners);

/// @param clock  value of --clock. @throws InputError when there are such UAVs but the clock is not real time.
void check_free_nodes(const std::vector<UavPlanner>& planners, const std::string& clock);

}  // namespace skein::cli
