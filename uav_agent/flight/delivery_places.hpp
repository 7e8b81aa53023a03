// Places from which a UAV can deliver captures to the station, and the time to fly there.
// Frame W.   Units: SI.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

/// Free places with a line of sight to the station as far as is known, best first. They are higher than the station;
/// each UAV has a preferred direction of its own, and delivery_layer_m(), so that the whole fleet can gather there.
/// @param lowest_m  least height of the places.
std::vector<Vector3d> delivery_places(const AgentConfig& agent, const FreeSpace& space, double lowest_m);

/// Height of this UAV's places above the lowest ones [m]. Eight UAVs have different heights; larger fleets share them.
double delivery_layer_m(const AgentConfig& agent);

/// Conservative estimate of the time to fly to a place [s]: it assumes a detour.
double time_home_s(const Vector3d& from_W, const Vector3d& place_W, double speed_mps);

}  // namespace skein::agent
