// What ROS 2 nodes said that fly UAVs in real time (core/planners/free_nodes.hpp): `from_nodes` of result.json, told to
// people.   Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "process/json_text.hpp"

namespace skein::results {

/// What the user should know of what nodes said. @param uavs  as in result.json.
std::vector<std::string> warnings_of_free_nodes(const Json& uavs);

/// A table for the summary, a line for each topic that nodes said anything on; empty: no UAV is flown so.
/// @param uavs  as in result.json.
std::string free_nodes_table(const Json& uavs);

}  // namespace skein::results
