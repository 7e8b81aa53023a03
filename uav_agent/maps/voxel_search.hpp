// Ways through a voxel grid from cube to cube, by A*. A step goes to one of the 26 cubes around and needs all cubes
// that it touches: no corner is cut. Unlike find_path() (uav_agent/flight/path_search.hpp), which searches free space
// of any kind, this is for planners whose world is the voxel graph, with cubes that others have claimed taken out.
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
  int max_expansions = 20'000;
  double heuristic_weight = 1.0;  ///< 1: the way is the shortest; more: at most so many times longer, and found sooner
};

/// @param passable  is asked at most once a cube; not about `from`.
/// @returns the cubes after `from` up to `to` (none if they are the same), or nullopt if there is no way or none was
/// found with that effort.
std::optional<std::vector<VoxelGrid::Id>> find_voxel_path(const VoxelGrid& grid, VoxelGrid::Id from, VoxelGrid::Id to,
                                                          const Passable& passable,
                                                          const VoxelSearchConfig& config = {});

/// The cubes to which a way leads, as find_voxel_path() would find it: true for each of them, and for `from`.
/// @returns nullopt if there are more than `max_cubes`.
std::optional<std::vector<bool>> voxels_in_reach(const VoxelGrid& grid, VoxelGrid::Id from, const Passable& passable,
                                                 std::size_t max_cubes = 20'000);

/// Length of the way along the centres [m].
double voxel_path_length(const VoxelGrid& grid, VoxelGrid::Id from, const std::vector<VoxelGrid::Id>& path);

}  // namespace skein::agent
