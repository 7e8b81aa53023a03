// Chooses where a UAV lands. UAVs may start closer to each other than the safety filter lets them land. Then each would
// hold the others in the air until their batteries are empty, so all of them land on a larger copy of their starting
// grid.
// Each UAV computes all places from the fleet's starts and its own apart_m. These differ by decimetres between UAVs, so
// the caller adds some room.
// Frame W.   Units: metres.   Pure; threads: any.
#pragma once

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

/// Place on the ground (z = 0): the UAV's start, if no other one starts within `apart_m` of it. Otherwise the UAVs
/// whose starts are linked by distances below apart_m are one group: all places of the group are moved away from its
/// centre by one factor, so that the closest two are apart_m apart. If that brings groups together, they are spread
/// again as one.
/// @param apart_m  least distance between two landed UAVs.
Vector3d landing_place_W(const AgentConfig& agent, double apart_m);

}  // namespace skein::agent
