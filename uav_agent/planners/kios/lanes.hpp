// The first stage of KIOS: lanes, which are straight paths along the longest axis of the operational volume. They are
// known before takeoff, and the explorers map everything from them in one quick pass.
// Frame W.   Units: metres.   Pure.   Source: paper, "Environmental Mapping"; that two explorers fly on opposite sides,
// and how high, is our choice.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

/// This UAV's lanes as corners in the order of flight, two for each lane; empty for a UAV without LiDAR. Lanes lie on
/// either side of the structure in turn, as near to its middle as the boxes leave room at that height, so that the
/// LiDAR reaches it.
/// @param lowest_m  least height of a lane.   @param lanes  of the whole fleet; raised to at least one per explorer.
std::vector<Vector3d> mapping_lanes(const AgentConfig& agent, const VoxelGrid& volume,
                                    const std::vector<OrientedBox>& boxes, double lowest_m, int lanes);

}  // namespace skein::agent
