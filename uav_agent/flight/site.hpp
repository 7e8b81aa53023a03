// What follows from the boxes and the fleet before anything has been seen: how high it is, what low space is blind, and
// whether anybody has a LiDAR to find out more with.
// Frame W.   Units: metres.   Pure.
#pragma once

#include <algorithm>
#include <vector>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

struct Site {
  double top_m = 0.0;           ///< of all boxes
  double blind_height_m = 0.0;  ///< see lift_off.hpp; 0 in a fleet without a LiDAR, which will never see what is there
  double lowest_m = 0.0;        ///< nobody of a fleet without a LiDAR flies lower; else 0
  bool blind_fleet = false;     ///< nobody has a LiDAR
  bool roomy = false;           ///< there is a box that is too large to be one piece of structure (is_roomy())

  /// What is higher is never low space that nobody has seen.
  double safe_height_m() const { return std::max(blind_height_m, lowest_m); }
};

/// Whether a box is too large to be one piece of structure whose faces are worth flying.
bool is_roomy(const OrientedBox& box);

/// z of the highest point of all boxes, 0 without boxes.
double top_of(const std::vector<OrientedBox>& boxes);

/// @param blind_height_ratio  see blind_height_m() in lift_off.hpp.
Site site_of(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, double blind_height_ratio);

/// From this UAV's centre to anything mapped, however small it is: the map's cells are coarse.
/// @param clearance_m  from its body.
double centre_clearance_m(const AgentConfig& agent, double clearance_m);

}  // namespace skein::agent
