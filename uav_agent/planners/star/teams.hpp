// STAR's balanced teams and its assignment of boxes to teams. Every UAV computes the same result from the fleet and the
// boxes; no message is needed. The assignment never changes, however unequal the work turns out to be (the published
// weakness).
// Frame W.   Units: metres.   Pure and deterministic.
// Source: paper, "Team Formation" and "Task Assignment" ("minimize the overall travel distance"); the weight of volume
// against path length is our choice.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/planners/star/config.hpp"

namespace skein::agent {

struct StarTeam {
  std::vector<std::size_t> uavs;   ///< the explorer first
  std::vector<std::size_t> boxes;  ///< in the order of visit
};

/// Photographers join the nearest explorer whose team is not full, nearest pair first; a team is full with
/// ceil(photographers / explorers) photographers. In a fleet without explorers, each UAV is a team.
std::vector<StarTeam> star_teams(const std::vector<FleetMember>& fleet);

/// How boxes are assigned to teams.
struct StarShare {
  double volume_weight = StarConfig().volume_weight;  ///< cost of a box: metres of path per cubic metre
  FleetTourObjective objective = StarConfig().share;
};

/// Assigns the boxes to the teams: a multiple travelling salesmen problem of the teams' first UAVs over the boxes'
/// centres, in which a box costs its volume times `volume_weight` in addition to the path to it. If there are at least
/// as many boxes as teams, each team gets one (with `longest`: mostly). With `total`, the volumes do not influence the
/// assignment: the sum of all tours always contains all of them.
void share_boxes(const std::vector<FleetMember>& fleet, const std::vector<OrientedBox>& boxes, const StarShare& share,
                 std::vector<StarTeam>& teams);

/// The team of one UAV, with its boxes.
/// @param helps  a team that got no box works on all boxes.
StarTeam own_team(const std::vector<FleetMember>& fleet, std::size_t self, const std::vector<OrientedBox>& boxes,
                  const StarShare& share, bool helps);

}  // namespace skein::agent
