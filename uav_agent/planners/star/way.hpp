// Ways through STAR's viewpoints: one after the other without a stop, corners rounded.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: bounded by counts.
// Source: Fast-Planner's trajectories are a search and a B-spline; here the search is on the map's cubes (or the finer
// lattice where these are too coarse), and rounding.hpp and the tracker make it smooth. All numbers are our choice.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

struct StarWayConfig {
  double round_m = 2.0;      ///< how far from a corner it may be cut off
  double horizon_m = 20.0;   ///< beyond, nothing is laid out
  double transit_mps = 4.0;  ///< on a long way to the first place
};

/// From `from_W` through the places, as many as there is a free way to, one after the other.
/// @param structure  boxes that a search may have to go around.
/// @returns nullopt if there is no way to the first place, or none was found with the effort that is allowed.
std::optional<Path> star_way(const VoxelGrid& grid, const FreeSpace& space, const std::vector<OrientedBox>& structure,
                             const Vector3d& from_W, const std::vector<Vector3d>& places_W, double speed_mps,
                             const StarWayConfig& config);

}  // namespace skein::agent
