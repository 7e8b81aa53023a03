// Finds places from which a UAV may climb if structure beside its start keeps it from climbing straight up. Beside a
// wall that is nearer than the safety filter allows, each step up would bring it nearer to the wall's higher parts.
// Frame W.   Units: SI.   Pure; threads: any.
#pragma once

#include <vector>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// Places around p_W at its height, best first: those with at least room_m before others, then by distance from p_W,
/// then by room. The room of a place is the least distance from known structure on the way straight up to top_m; all
/// places have more room than p_W.
/// @param top_m   z in W at which the climb ends.
/// @param room_m  room that is enough.
std::vector<Vector3d> places_aside_W(const Vector3d& p_W, double top_m, double room_m, const WorldMap& map);

}  // namespace skein::agent
