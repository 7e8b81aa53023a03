// Who works with whom, and where: STAR's balanced teams and its assignment of boxes to teams. Everybody computes the
// same from the fleet and the boxes; no message is needed, and nothing is ever shared out anew, however unequal the
// work turns out to be (the published weakness).
// Frame W.   Units: metres.   Pure and deterministic.
// Source: paper, "Team Formation" and "Task Assignment" ("minimize the overall travel distance"); the weight of volume
// against way is our choice.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/planning/fleet_tours.hpp"

namespace skein::agent {

struct StarTeam {
  std::vector<std::size_t> uavs;   ///< the explorer first
  std::vector<std::size_t> boxes;  ///< in the order of visit
};

/// Photographers join the nearest explorer that has room, nearest pair first; a team has room for
/// ceil(photographers / explorers). A fleet without explorers makes a team of each UAV.
std::vector<StarTeam> star_teams(const std::vector<FleetMember>& fleet);

/// How boxes are shared out.
struct StarShare {
  double volume_weight = 0.005;  ///< metres of way that a cubic metre of box counts for
  FleetTourObjective objective = FleetTourObjective::total;
};

/// Shares the boxes out: a multiple travelling salesmen problem of the teams' first UAVs over the boxes' centres, in
/// which a box costs its volume times `volume_weight` beside the way to it. Where there are as many boxes as teams,
/// each team has one (with `longest`: mostly). The sum of all tours has all volumes in it, whoever gets which.
void share_boxes(const std::vector<FleetMember>& fleet, const std::vector<OrientedBox>& boxes, const StarShare& share,
                 std::vector<StarTeam>& teams);

/// The team of one UAV, with its boxes.
/// @param helps  a team that got no box works on everybody's.
StarTeam own_team(const std::vector<FleetMember>& fleet, std::size_t self, const std::vector<OrientedBox>& boxes,
                  const StarShare& share, bool helps);

}  // namespace skein::agent
