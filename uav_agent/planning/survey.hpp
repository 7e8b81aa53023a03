// One quick round of all structure by the UAVs with a LiDAR, so that everybody knows where the surfaces are.
// Frame W.   Units: SI.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

/// The explorer's share of a ring around the convex hull of all boxes, seen from above.
/// @param standoff_m  of the ring from the hull.   @param height_m  of the ring.
/// @returns corners in the order of flight; empty for a UAV without LiDAR.
std::vector<Vector3d> survey_ring(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, double standoff_m,
                                  double height_m);

}  // namespace skein::agent
