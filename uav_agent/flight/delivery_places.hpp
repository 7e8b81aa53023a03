// Where captures can be delivered from, and how long it takes to get there.
// Frame W.   Units: SI.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

/// Places with a free line to the station as far as is known, best first: above it, each UAV at a height and
/// in a direction of its own, so that the whole fleet can gather there.
/// @param lowest_m  no place is lower than this.
std::vector<Vector3d> delivery_places(const AgentConfig& agent, const FreeSpace& space, double lowest_m);

/// Time to fly to `place`, on the safe side: the way is not straight [s].
double time_home_s(const Vector3d& from_W, const Vector3d& place_W, double speed_mps);

}  // namespace skein::agent
