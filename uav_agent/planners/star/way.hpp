// Paths through STAR's viewpoints: straight from one to the next without a stop, with rounded corners. Paths around
// obstacles are left to the flight core.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: bounded by counts.
// Source: Fast-Planner's trajectories are a search and a B-spline; here the flight core searches, and rounding.hpp and
// the tracker make the path smooth. All numbers are our choice.
#pragma once

#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/star/config.hpp"

namespace skein::agent {

struct StarWayConfig {
  double round_m = StarConfig().round_m;      ///< how far from a corner the path may leave it to round it
  double horizon_m = StarConfig().horizon_m;  ///< the path ends at the first place beyond this length
  double speed_mps = StarConfig().inspect_mps;
  double transit_mps = FlightConfig().approach_mps;  ///< speed to a first place that is far away
};

/// A path from `from_W` through the first places, as many as can be reached in straight free segments, up to the
/// horizon. Empty: not even the first one can.
std::vector<Waypoint> star_way(const FreeSpace& space, const Vector3d& from_W, const std::vector<Vector3d>& places_W,
                               const StarWayConfig& config);

}  // namespace skein::agent
