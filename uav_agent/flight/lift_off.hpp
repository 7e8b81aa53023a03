// Leaving the ground: how high everybody goes before it flies anywhere, so that a fleet that starts close together
// comes apart, and nobody enters low space that no LiDAR has seen. Who goes first: Separation::lifts_off_after().
// Frame W.   Units: metres.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

/// Below this height, only space that was seen to be free may be entered: podiums and trees are in no box, and there
/// may be a roof over what low boxes hold. A low site is seen from above first, all of it.
/// @param ratio  of the highest box's top, on a site that is not low.   @returns 0 without boxes.
double blind_height_m(const std::vector<OrientedBox>& boxes, double ratio);

/// Height to climb to, straight up: a layer of its own for each UAV, above the blind space, and above a roomy box
/// (site.hpp) that it stands in or below; in a fleet without a LiDAR no higher than fits below a box that hangs over
/// the start.
/// @param blind_m  see blind_height_m(); 0: no such space.   @param clearance_m  from the body to a box above.
double lift_off_height_m(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const Vector3d& p_WB,
                         double blind_m, double clearance_m);

inline constexpr double kRoofM = 10.0;  ///< above a start: no roof over starts is higher

inline constexpr double kColumnM = 0.6;  ///< around the body, for whoever climbs

/// How far up the way straight up is open as far as the map tells: nothing is mapped within `room_m` of the body, and
/// inside boxes and below `roof_m` it has been looked at. What little is asked for finds a roof, not a cable: who
/// climbs goes on looking out.
/// @param ground_m  height of the start: some metres above it are free.   @returns from_W.z() to `wanted_m`.
double open_height_m(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const OccupancyMap& map,
                     const Vector3d& from_W, double ground_m, double roof_m, double wanted_m, double room_m = kColumnM);

}  // namespace skein::agent
