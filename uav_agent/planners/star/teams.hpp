// Who works with whom, and where: STAR's balanced teams and its assignment of boxes to teams. Everybody computes the
// same from the fleet and the boxes; no message is needed, and nothing is ever shared out anew, however unequal the
// work turns out to be (the published weakness).
// Frame W.   Units: metres.   Pure and deterministic.
// Source: paper, "Team Formation" and "Task Assignment"; the weight of volume against way is our choice.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

struct StarTeam {
  std::vector<std::size_t> uavs;   ///< the explorer first
  std::vector<std::size_t> boxes;  ///< in the order of visit
};

/// Photographers join the nearest explorer that has room, nearest pair first; a team has room for
/// ceil(photographers / explorers). A fleet without explorers makes a team of each UAV.
std::vector<StarTeam> star_teams(const std::vector<FleetMember>& fleet);

/// Shares the boxes out: a multiple travelling salesmen problem of the teams' first UAVs over the boxes' centres, in
/// which a box costs its volume times `volume_weight` beside the way to it.
void share_boxes(const std::vector<FleetMember>& fleet, const std::vector<OrientedBox>& boxes, double volume_weight,
                 std::vector<StarTeam>& teams);

/// The team of one UAV, with its boxes.
/// @param helps  a team that got no box works on everybody's.
StarTeam own_team(const std::vector<FleetMember>& fleet, std::size_t self, const std::vector<OrientedBox>& boxes,
                  double volume_weight, bool helps);

}  // namespace skein::agent
