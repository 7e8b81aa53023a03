// Orders of visit in STAR. For an explorer: one asymmetric travelling salesman problem (ATSP). For a photographer: an
// ATSP over clusters of viewpoints that see each other, then one inside each of the first two clusters.
// Frame W.   Units: SI.   Pure and deterministic.   Effort: bounded by counts.
// Source: FUEL (time-like cost, penalty for a change of direction), Star-Searcher (visibility clusters, hierarchical
// ATSP, history-aware cost).
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"
#include "uav_agent/planners/star/config.hpp"

namespace skein::agent {

struct StarTourConfig {
  double speed_mps = StarConfig().inspect_mps;
  double turn_s = StarConfig().turn_s;           ///< cost of a change of direction at the start, per radian
  double radius_m = StarConfig().view_radius_m;  ///< of a cluster of viewpoints
  double history_s = StarConfig().history_s;     ///< cost of another first cluster than in the last plan
  /// Cost of beginning where another UAV is about to work.
  double mate_s = StarConfig().resolved().mate_s.value();
  std::size_t effort = static_cast<std::size_t>(StarConfig().effort);
};

/// An order in which a UAV at p_W with velocity v_W visits all places once; it may end anywhere.
/// @returns indices into places_W.
/// @param extra_s  cost of beginning with each place, in addition to the path to it; empty: none.
std::vector<std::size_t> order_of_visit(const Vector3d& p_W, const Vector3d& v_W, const std::vector<Vector3d>& places_W,
                                        const std::vector<double>& extra_s, const StarTourConfig& config);

struct StarTour {
  std::vector<std::size_t> visits;              ///< indices of all places, cluster by cluster
  Vector3d first_cluster_W = Vector3d::Zero();  ///< middle of the first cluster
};

/// A tour over clusters. Beyond the second cluster, only the order of the clusters is optimised, not that inside them.
/// @param last_W  first_cluster_W of the last plan.   @param mates_W  where other UAVs are about to work.
StarTour hierarchical_tour(const VoxelGrid& grid, const Vector3d& p_W, const Vector3d& v_W,
                           const std::vector<Vector3d>& places_W, const std::optional<Vector3d>& last_W,
                           const std::vector<Vector3d>& mates_W, const StarTourConfig& config);

}  // namespace skein::agent
