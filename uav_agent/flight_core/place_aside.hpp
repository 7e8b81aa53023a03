// Where a UAV may climb instead of straight up, when structure beside its start holds it down: along a wall that is
// nearer than the safety filter allows, each step up comes nearer to what is above.
// Frame W.   Units: SI.   Pure; threads: any.
#pragma once

#include <vector>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// Places around p_W at its height, the best first: those with room before others, then by distance from p_W, then by
/// room. The room of a place is the least distance from known structure on the way straight up; all places have more
/// room than p_W.
/// @param top_m   height of the end of the climb.
/// @param room_m  a place with so much has room.
std::vector<Vector3d> places_aside_W(const Vector3d& p_W, double top_m, double room_m, const WorldMap& map);

}  // namespace skein::agent
