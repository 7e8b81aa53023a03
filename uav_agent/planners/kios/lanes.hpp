// The first stage of KIOS: paths straight along the longest axis of the operational volume, known before take-off, from
// which the explorers map everything in one quick pass.
// Frame W.   Units: metres.   Pure.   Source: paper, "Environmental Mapping"; that two explorers fly on opposite sides,
// and how high, is our choice.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

/// Lanes run on either side in turn, as near to the middle of the structure as the boxes leave room at that height, so
/// that the LiDAR reaches it. This is the UAV's own lane, or lanes one after the other, as corners in the order of
/// flight; empty for a UAV without LiDAR.
/// @param lowest_m  no lane is lower, unless the volume is.   @param lanes  in all; at least one each explorer.
std::vector<Vector3d> mapping_lanes(const AgentConfig& agent, const VoxelGrid& volume,
                                    const std::vector<OrientedBox>& boxes, double lowest_m, int lanes);

}  // namespace skein::agent
