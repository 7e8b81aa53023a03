// Paths through a voxel grid from cube to cube, by A*. A step goes to one of the 26 cubes around; all cubes that it
// touches must be passable, so no corner is cut. find_path() (uav_agent/flight/path_search.hpp) searches a FreeSpace;
// this search is for planners that work on the voxel graph, without the cubes that other UAVs have claimed.
// Units: metres.   Pure and deterministic: effort is bounded by a count of expanded cubes.
// Source: the graph of KIOS, whose edges to claimed voxels are removed; A* of XXH.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

using Passable = std::function<bool(VoxelGrid::Id)>;

struct VoxelSearchConfig {
  int max_expansions = 20'000;  ///< chosen: bounds the CPU time
  /// 1: the shortest path; more: found sooner, and longer by this factor at most. Chosen.
  double heuristic_weight = 1.0;
};

/// @param passable  called at most once for each cube, and never for `from`.
/// @returns the cubes after `from` up to `to` (none if they are the same); nullopt if there is no path, or none was
/// found within max_expansions.
std::optional<std::vector<VoxelGrid::Id>> find_voxel_path(const VoxelGrid& grid, VoxelGrid::Id from, VoxelGrid::Id to,
                                                          const Passable& passable,
                                                          const VoxelSearchConfig& config = {});

/// All cubes that find_voxel_path() could reach with unlimited effort: by cube, true for each of them and for `from`.
/// @param max_cubes  chosen: bounds the CPU time.   @returns nullopt if there are more.
std::optional<std::vector<bool>> voxels_in_reach(const VoxelGrid& grid, VoxelGrid::Id from, const Passable& passable,
                                                 std::size_t max_cubes = 20'000);

}  // namespace skein::agent
