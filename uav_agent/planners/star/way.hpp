// Ways through STAR's viewpoints: straight from one to the next without a stop, corners rounded. Ways around anything
// are the flight core's business.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: bounded by counts.
// Source: Fast-Planner's trajectories are a search and a B-spline; here the flight core searches, and rounding.hpp and
// the tracker make it smooth. All numbers are our choice.
#pragma once

#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

struct StarWayConfig {
  double round_m = 2.0;     ///< how far from a corner it may be cut off
  double horizon_m = 20.0;  ///< beyond, nothing is laid out
  double speed_mps = 2.0;
  double transit_mps = 5.0;  ///< on a long way to the first place
};

/// From `from_W` through the places, as many as can be flown to straight, one after the other. Empty: not even the
/// first.
std::vector<Waypoint> star_way(const FreeSpace& space, const Vector3d& from_W, const std::vector<Vector3d>& places_W,
                               const StarWayConfig& config);

}  // namespace skein::agent
