// How STAR's explorers go about a box: frontiers, one best viewpoint for each cluster of them, and the order of visit.
// Frontiers in the empty volume of a box count like those at structure: that this takes time is the published weakness.
// Frame W.   Units: SI.   Threads: one.   Effort: bounded by counts.
// Source: paper ("Explorer Strategy"), FUEL (frontier information structure, cylindrical sampling, ATSP, refinement).
// Our choice: unknown cubes behind known surface and at the ground are no frontier, as cubes here are as large as a
// wall is thick; a frontier that stays one while the LiDAR is near is given up (FUEL's dormant clusters).
#pragma once

#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/frontiers.hpp"

namespace skein::agent {

/// A place to explore from.
struct StarGoal {
  Vector3d p_WB = Vector3d::Zero();
  Vector3d middle_W = Vector3d::Zero();   ///< of the frontier
  std::vector<VoxelGrid::Id> cubes = {};  ///< of it
};

/// What makes one place better to begin with than another.
struct StarStart {
  Vector3d p_WB = Vector3d::Zero(), v_WB = Vector3d::Zero();
  std::vector<Vector3d> mates_W = {};  ///< where others are about to work
};

class StarExplorer {
 public:
  struct Config {
    double speed_mps = 2.5;
    double turn_s = 1.5;  ///< cost of a change of direction, a radian
    double mate_s = 8.0;  ///< cost of beginning near where another is about to work
    double cluster_m = 8.0;
    std::size_t min_cluster = 3;
    double ring_inner_m = 5.0, ring_outer_m = 11.0;
    double margin_m = 3.0;  ///< around a box
    int refine = 5;
    int looks = 6;          ///< of look(), near by, after which a frontier is given up
    double retry_s = 15.0;  ///< before one that could not be reached is tried again
    std::size_t effort = 30'000;
  };

  /// @param grid  for its size.
  StarExplorer(const Config& config, const VoxelGrid& grid)
      : config_(config), looks_(grid.count(), 0), not_before_(grid.count(), 0) {}

  /// Takes note of what changed on the map, and of which frontiers lie in view of the LiDAR at p_W.
  void look(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& changed, const Vector3d& p_W);

  /// Viewpoints for all frontiers of one box, in the order of visit. Empty: nothing is left that can be explored now.
  std::vector<StarGoal> tour(const VoxelGrid& grid, const FreeSpace& space, const OrientedBox& box,
                             const StarStart& start, Tick now) const;

  /// Whether more than half of the goal's frontier is still one.
  bool open(const StarGoal& goal) const;
  /// It could not be reached: something else first.
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
