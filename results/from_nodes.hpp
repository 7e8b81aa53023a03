// Texts for the user about the messages of ROS 2 nodes that fly UAVs in real time (core/planners/free_nodes.hpp), from
// `from_nodes` of result.json.   Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "process/json_text.hpp"

namespace skein::results {

/// Warns of UAVs whose nodes sent nothing, and of stamps from another clock. @param uavs  `uavs` of result.json.
std::vector<std::string> warnings_of_free_nodes(const Json& uavs);

/// A table for the summary, with a line for each topic on which nodes sent anything; empty: there is no such topic.
/// @param uavs  `uavs` of result.json.
std::string free_nodes_table(const Json& uavs);

}  // namespace skein::results
