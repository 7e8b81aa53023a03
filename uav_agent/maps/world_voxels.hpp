// Transfers the world map (world_map.hpp) to a coarser voxel grid, for strategies that plan in larger cubes. A cube of
// the grid is occupied if it holds an occupied cube of the map; it is free if all space around its centre is free. This
// class also keeps the mean position of the surface in each cube.
// Doubted cubes of the map (WorldMap::doubt()) do not count as occupied, because a cube of the grid cannot become free
// again.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
// Effort: chunks of the map that changed since the last update, and at most max_looks unknown cubes.
#pragma once

#include <bitset>
#include <optional>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class WorldVoxels {
 public:
  static constexpr double kUpdateS = 1.0;  ///< time between two calls of update() in the planners; chosen

  struct Config {
    double around_m = 1.0;         ///< radius around a cube's centre that must be free for the cube to be free; chosen
    std::size_t max_looks = 8000;  ///< most unknown cubes examined in one update; they take turns; chosen
  };

  WorldVoxels() : WorldVoxels(Config()) {}
  explicit WorldVoxels(const Config& config) : config_(config) {}

  /// @param map, grid  the same at each call.
  void update(const WorldMap& map, VoxelGrid& grid);

  /// Mean position of the map's occupied cubes in a cube of the grid; nullopt if there are none. The grid may still
  /// have the cube as occupied, because another UAV reported it.
  std::optional<Vector3d> surface_W(VoxelGrid::Id id) const;
  /// Number of the map's occupied cubes in a cube of the grid.
  int hits(VoxelGrid::Id id) const { return id < hits_.size() ? hits_[id].count : 0; }

 private:
  struct Hits {
    Vector3d sum_W = Vector3d::Zero();
    int count = 0;
  };
  /// State of a chunk of the map: its revisions at the last look, and which of its cubes are counted in hits_.
  struct Counted {
    std::uint64_t changed_at = 0, structure_changed_at = 0;
    bool any_in_doubt = false;
    std::bitset<MapLevel::kCells> cubes = {};
  };

  void find_occupied(const WorldMap& map, VoxelGrid& grid);
  /// Called for a changed chunk: marks the cubes of the grid in and around it for another look.
  void note(const WorldMap& map, const WorldMap::Cube& chunk, const VoxelGrid& grid);
  void count(const WorldMap& map, const WorldMap::Cube& chunk, std::uint64_t changed_at, VoxelGrid& grid);
  /// Counts an occupied cube of a chunk, unless it is in doubt.
  void count(const WorldMap& map, const WorldMap::Cube& chunk, std::size_t place, Counted& counted, VoxelGrid& grid);
  void find_free(const WorldMap& map, VoxelGrid& grid);

  const Config config_;
  std::vector<Hits> hits_;  ///< by cube of the grid
  BlockTable<Counted> chunks_;
  BlockTable<std::uint64_t> regions_;  ///< by region of the map: region_changed_at() at the last look
  VoxelGrid::Id next_look_ = 0;
  /// By cube of the grid: 0 if nothing around the cube has changed since the last look found it not to be free.
  std::vector<std::uint8_t> look_again_;
};

}  // namespace skein::agent
