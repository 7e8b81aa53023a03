// Orders of visit in STAR: one ATSP for an explorer; for a photographer two, over clusters of viewpoints that see each
// other and then inside the first two clusters.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: bounded by counts.
// Source: FUEL (time-like cost, penalty for a change of direction), Star-Searcher (visibility clusters, hierarchical
// ATSP, history-aware cost).
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

struct StarTourConfig {
  double speed_mps = 2.0;
  double turn_s = 1.5;     ///< cost of a change of direction at the start, a radian
  double radius_m = 10.0;  ///< of a cluster of viewpoints
  double history_s = 4.0;  ///< cost of beginning with another cluster than last time
  double mate_s = 8.0;     ///< cost of beginning where another UAV is about to work
  std::size_t effort = 30'000;
};

/// All places once, from where the UAV is and flies to; it may end anywhere.
/// @param extra_s  cost of beginning with a place, beside the way to it; empty: none.
std::vector<std::size_t> order_of_visit(const Vector3d& p_W, const Vector3d& v_W, const std::vector<Vector3d>& places_W,
                                        const std::vector<double>& extra_s, const StarTourConfig& config);

struct StarTour {
  std::vector<std::size_t> visits;              ///< of all places: those of the first cluster first, and so on
  Vector3d first_cluster_W = Vector3d::Zero();  ///< its middle
};

/// @param last_W  the middle of last time's first cluster.   @param mates_W  where others are about to work.
/// Places beyond the second cluster are in the clusters' order, but not put in order inside.
StarTour hierarchical_tour(const VoxelGrid& grid, const Vector3d& p_W, const Vector3d& v_W,
                           const std::vector<Vector3d>& places_W, const std::optional<Vector3d>& last_W,
                           const std::vector<Vector3d>& mates_W, const StarTourConfig& config);

}  // namespace skein::agent
