// Where the known ends: free cubes with an unknown neighbour, kept up to date as the map grows (only what changed and
// its neighbours are looked at), and the clusters that they form.
// Frame W.   Units: metres.   Threads: one.   Deterministic.   Effort: in proportion to what changed; clusters() to the
// number of frontier cubes.
// Source: Yamauchi 1997; incremental bookkeeping and clusters split along their longest spread as in FUEL (STAR).
#pragma once

#include <set>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

struct CubeCluster {
  std::vector<VoxelGrid::Id> cubes;  ///< ascending
  Vector3d middle_W = Vector3d::Zero();
};

class Frontiers {
 public:
  using Id = VoxelGrid::Id;

  /// @param changed  all cubes whose state has changed since the last call; see VoxelGrid::take_changed().
  void update(const VoxelGrid& grid, const std::vector<Id>& changed);

  /// In ascending order.
  const std::set<Id>& cubes() const { return cubes_; }
  /// What a frontier is; for whoever wants to know it of one cube.
  static bool is_frontier(const VoxelGrid& grid, Id id);

  using Cluster = CubeCluster;
  /// Frontier cubes that touch (26 neighbours), in pieces of at most `max_m` along their direction of greatest spread.
  /// @param min_cubes  smaller clusters are left out.
  std::vector<Cluster> clusters(const VoxelGrid& grid, double max_m, std::size_t min_cubes) const;

 private:
  std::set<Id> cubes_;
};

/// Cubes of any kind that touch (26 neighbours), in pieces as above.   @param cubes  ascending.
std::vector<CubeCluster> clusters_of(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& cubes, double max_m,
                                     std::size_t min_cubes);

/// Cuts a set of cubes in halves across its direction of greatest spread until no piece is longer than `max_m`.
void split_by_spread(const VoxelGrid& grid, std::vector<VoxelGrid::Id> cubes, double max_m,
                     std::vector<std::vector<VoxelGrid::Id>>& pieces);

}  // namespace skein::agent
