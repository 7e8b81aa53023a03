// UAVs that ROS 2 nodes fly in real time, outside of the lock-step: `--clock realtime --planner UAV=ros`
// (docs/ros2.md).
#pragma once

#include <string>
#include <vector>

#include "cli/planner_spec.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// Their names, in the order of the planners.
std::vector<std::string> uavs_of_free_nodes(const std::vector<UavPlanner>& planners);

/// @param clock  as --clock takes it. @throws InputError when there are such UAVs, and the clock is not real time.
void check_free_nodes(const std::vector<UavPlanner>& planners, const std::string& clock);

/// What the user should know of what those nodes said. @param uavs  as in result.json.
std::vector<std::string> warnings_of_free_nodes(const Json& uavs);

/// A table for the summary, a line for each topic that nodes said anything on; empty: no UAV is flown so.
/// @param uavs  as in result.json.
std::string free_nodes_table(const Json& uavs);

}  // namespace skein::cli
