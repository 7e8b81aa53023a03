// Frontiers: free cubes with an unknown neighbour, and the clusters that they form. An update looks only at cubes that
// have changed and at their neighbours.
// Frame W.   Units: metres.   Threads: one.   Deterministic.   Effort: update() in proportion to the number of changed
// cubes; clusters() to the number of frontier cubes, plus one bit for each cube of the grid.
// Source: Yamauchi 1997; incremental bookkeeping and clusters split along their longest spread as in FUEL (STAR).
#pragma once

#include <set>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

struct CubeCluster {
  std::vector<VoxelGrid::Id> cubes;      ///< ascending
  Vector3d middle_W = Vector3d::Zero();  ///< mean of the cubes' centres
};

class Frontiers {
 public:
  using Id = VoxelGrid::Id;

  /// @param changed  all cubes whose state has changed since the last call; see VoxelGrid::take_changed().
  void update(const VoxelGrid& grid, const std::vector<Id>& changed);

  /// In ascending order.
  const std::set<Id>& cubes() const { return cubes_; }
  /// Whether the cube is free, and a cube that shares a face with it is unknown.
  static bool is_frontier(const VoxelGrid& grid, Id id);

  using Cluster = CubeCluster;
  /// Connected sets of frontier cubes (26 neighbours), cut into pieces of at most `max_m` along their direction of
  /// greatest spread. @param min_cubes  pieces with fewer cubes are left out.
  std::vector<Cluster> clusters(const VoxelGrid& grid, double max_m, std::size_t min_cubes) const;

 private:
  std::set<Id> cubes_;
};

/// The same for any set of cubes.   @param cubes  ascending.
std::vector<CubeCluster> clusters_of(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& cubes, double max_m,
                                     std::size_t min_cubes);

/// Cuts a set of cubes in halves across its direction of greatest spread until no piece is longer than `max_m`.
void split_by_spread(const VoxelGrid& grid, std::vector<VoxelGrid::Id> cubes, double max_m,
                     std::vector<std::vector<VoxelGrid::Id>>& pieces);

}  // namespace skein::agent
