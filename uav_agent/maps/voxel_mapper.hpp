// From what the LiDARs saw (occupancy_map.hpp) to a voxel grid: a cube that holds hits is occupied, one whose middle
// rays have passed is free. Beside it, where in each cube the surface is.
// Frame W.   Units: metres.   Threads: one.   Bounded: a look at all hits when there are new ones, and at a counted
// number of unknown cubes; whoever calls it once a second has time for more important things.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

class VoxelMapper {
 public:
  struct Config {
    int rays = kProofRays;         ///< that must have passed the middle of a cube
    double around_m = 1.0;         ///< and places this far from it along the axes
    int min_hits = 1;              ///< mapped cells (0.5 m) that make a cube occupied
    std::size_t max_looks = 8000;  ///< unknown cubes looked at in one update; they take turns
  };

  VoxelMapper() : VoxelMapper(Config()) {}
  explicit VoxelMapper(const Config& config) : config_(config) {}

  void update(const OccupancyMap& map, VoxelGrid& grid);

  /// The mean of the hits in a cube; nullopt if this UAV knows of none (others may have told of them).
  std::optional<Vector3d> surface_W(VoxelGrid::Id id) const;
  /// What others have told beyond what this UAV knows well itself, for FreeSpace::Config::hearsay: the grid without
  /// the occupied cubes that hold so many hits of its own that the finer map is good enough to fly by.
  VoxelGrid hearsay(const VoxelGrid& grid) const;
  /// Mapped cells in a cube, of those that this UAV knows of.
  int hits(VoxelGrid::Id id) const { return id < hits_.size() ? hits_[id].count : 0; }

 private:
  void find_occupied(const OccupancyMap& map, VoxelGrid& grid);
  void find_free(const OccupancyMap& map, VoxelGrid& grid);

  struct Hits {
    Vector3d sum_W = Vector3d::Zero();
    int count = 0;
  };

  const Config config_;
  std::vector<Hits> hits_;  ///< by cube
  std::uint64_t seen_revision_ = 0;
  VoxelGrid::Id next_look_ = 0;
};

}  // namespace skein::agent
