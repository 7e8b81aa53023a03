// This UAV's share of all strips. Each UAV computes the same division from the boxes and the nominal starts.
// Frame W.   Units: SI.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/planning/standoff.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

struct WorkShareConfig {
  StripConfig strips;
  StandoffConfig standoff;
  double transit_mps = 4.5;  ///< speed between strips; chosen
};

struct WorkShare {
  std::vector<Strip> strips;  ///< strips of the whole fleet
  std::vector<Visit> tour;    ///< strips of this UAV, in order
};

/// Division for fleets in which the explorers' LiDARs prove the space in which photographers fly. An explorer and the
/// photographers that start near it are a team, with equal numbers as far as possible; each team has a part of the
/// site. In a team of n UAVs, each flies every n-th strip of that part. Without explorers, or without photographers,
/// each UAV is a team. Strips that the boxes alone make impossible to fly, for example inside another box, are left
/// out.
/// @param middle_height_m  height at which all tours are assumed to begin.
WorkShare team_share(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                     double middle_height_m, const WorkShareConfig& config);

}  // namespace skein::agent
