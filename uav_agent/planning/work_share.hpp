// Who does what: this UAV's part of all strips. Every UAV computes the same division from the boxes and the
// nominal starts.
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
  double transit_mps = 4.5;
};

struct WorkShare {
  std::vector<Strip> strips;  ///< of the whole fleet
  std::vector<Visit> tour;    ///< own
};

/// For fleets whose LiDARs prove where others may fly: each explorer has a part of the site together with the
/// photographers that start near it. In a team of n, the explorer flies every n-th strip of that part, and each
/// photographer as many of those between. Without explorers, or without photographers, each UAV is a team.
/// Strips that run inside another box all along are nobody's.
/// @param middle_height_m  at which everybody is taken to begin.
WorkShare team_share(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                     double middle_height_m, const WorkShareConfig& config);

}  // namespace skein::agent
