// From the map of all beams (world_map.hpp) to a coarser voxel grid, for strategies that plan in cubes of their own: a
// cube that holds something occupied is occupied, one with free space all about its middle is free. Beside it, where in
// each cube the surface is.
// What may have been a UAV (WorldMap::doubt()) counts for nothing: the grid forgets nothing.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
// Effort: chunks of the map that changed since the last update, and a counted number of unknown cubes.
#pragma once

#include <bitset>
#include <optional>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class WorldVoxels {
 public:
  struct Config {
    double around_m = 1.0;         ///< about the middle of a cube that is free, all must be free
    std::size_t max_looks = 8000;  ///< unknown cubes looked at in one update; they take turns
  };

  WorldVoxels() : WorldVoxels(Config()) {}
  explicit WorldVoxels(const Config& config) : config_(config) {}

  /// @param map, grid  the same at each call.
  void update(const WorldMap& map, VoxelGrid& grid);

  /// The mean of what is occupied in a cube; nullopt if this UAV knows of nothing (others may have told of it).
  std::optional<Vector3d> surface_W(VoxelGrid::Id id) const;
  /// Occupied cubes of the map in a cube of the grid.
  int hits(VoxelGrid::Id id) const { return id < hits_.size() ? hits_[id].count : 0; }

 private:
  void find_occupied(const WorldMap& map, VoxelGrid& grid);
  /// Something of the chunk has changed: the cubes of the grid about it are to be looked at again.
  void note(const WorldMap& map, const WorldMap::Cube& chunk, const VoxelGrid& grid);
  void count(const WorldMap& map, const WorldMap::Cube& chunk, std::uint64_t changed_at, VoxelGrid& grid);
  void find_free(const WorldMap& map, VoxelGrid& grid);

  struct Hits {
    Vector3d sum_W = Vector3d::Zero();
    int count = 0;
  };
  /// Of a chunk of the map: when it was looked at last, and which of its cubes are counted.
  struct Counted {
    std::uint64_t changed_at = 0, structure_changed_at = 0;
    bool any_in_doubt = false;
    std::bitset<MapLevel::kCells> cubes = {};
  };

  const Config config_;
  std::vector<Hits> hits_;  ///< by cube
  BlockTable<Counted> chunks_;
  BlockTable<std::uint64_t> regions_;  ///< when they were looked at last
  VoxelGrid::Id next_look_ = 0;
  /// By cube: 0 if nothing about it has changed since it was found not to be free.
  std::vector<std::uint8_t> look_again_;
};

}  // namespace skein::agent
