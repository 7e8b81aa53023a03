// How STAR's explorers explore a box: frontiers in clusters, the best viewpoint for each cluster, the order of visit.
// Frontiers in the empty volume of a box count like those at structure: the time that this takes is the published
// weakness.
// Frame W.   Units: SI.   Threads: one.   Effort: bounded by counts.
// Source: paper ("Explorer Strategy"), FUEL (frontier information structure, cylindrical sampling, ATSP, refinement).
// Our choice: unknown cubes behind known surface or at the ground make no frontier, because the cubes are as large as
// walls are thick; a cube that is still frontier after several looks of a LiDAR nearby is given up (FUEL's dormant
// clusters).
#pragma once

#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/frontiers.hpp"
#include "uav_agent/planners/star/config.hpp"

namespace skein::agent {

/// A viewpoint of an explorer.
struct StarGoal {
  Vector3d p_WB = Vector3d::Zero();
  Vector3d middle_W = Vector3d::Zero();   ///< middle of the frontier cluster
  std::vector<VoxelGrid::Id> cubes = {};  ///< frontier cubes of the cluster
};

/// What the cost of the first viewpoint depends on.
struct StarStart {
  Vector3d p_WB = Vector3d::Zero(), v_WB = Vector3d::Zero();
  std::vector<Vector3d> mates_W = {};  ///< where other UAVs are about to work
};

class StarExplorer {
 public:
  struct Config {
    double speed_mps = StarConfig().explore_mps;
    double turn_s = StarConfig().turn_s;  ///< cost of a change of direction, per radian
    /// Cost of beginning near where another UAV is about to work.
    double mate_s = StarConfig().resolved().mate_s.value();
    double cluster_m = StarConfig().cluster_m;
    std::size_t min_cluster = static_cast<std::size_t>(StarConfig().min_cluster);
    double ring_inner_m = StarConfig().ring_inner_m, ring_outer_m = StarConfig().ring_outer_m;
    double margin_m = 3.0;  ///< width of the space around a box that is explored with it; chosen
    int refine = StarConfig().refine;
    int looks = StarConfig().looks;  ///< calls of look() with the cube near by, after which it is given up
    double retry_s = 15.0;           ///< wait before an unreachable frontier is tried again; chosen
    std::size_t effort = static_cast<std::size_t>(StarConfig().effort);
  };

  /// @param grid  only its size is used.
  StarExplorer(const Config& config, const VoxelGrid& grid)
      : config_(config), looks_(grid.count(), 0), not_before_(grid.count(), 0) {}

  /// Updates the frontiers from the cubes that changed, and counts a look for those in view of the LiDAR at p_W.
  void look(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& changed, const Vector3d& p_W);

  /// Viewpoints for the nearest frontier clusters of a box, in the order of visit. Empty: nothing can be explored now.
  std::vector<StarGoal> tour(const VoxelGrid& grid, const FreeSpace& space, const OrientedBox& box,
                             const StarStart& start, Tick now) const;

  /// Whether more than half of the goal's cubes are still frontier.
  bool open(const StarGoal& goal) const;
  /// The goal could not be reached: tour() leaves its cubes out for a while (Config::retry_s).
  void failed(const StarGoal& goal, Tick now);

 private:
  struct Options;
  bool worth_a_look(const VoxelGrid& grid, VoxelGrid::Id id) const;
  std::vector<CubeCluster> clusters(const VoxelGrid& grid, const OrientedBox& box, const Vector3d& p_W, Tick now) const;
  Options options_for(const VoxelGrid& grid, const FreeSpace& space, const CubeCluster& cluster) const;
  std::vector<std::size_t> order(const std::vector<Options>& options, const StarStart& start) const;

  const Config config_;
  Frontiers frontiers_;
  std::vector<std::uint8_t> looks_;  ///< by cube
  std::vector<Tick> not_before_;     ///< by cube
};

}  // namespace skein::agent
