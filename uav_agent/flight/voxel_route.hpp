// Path search through the cubes of a voxel grid, with the result as corners that a UAV can fly: a straight line if that
// is free; else A* through the cubes, shortened by free short cuts. Each leg is checked against the finer map
// (free_space.hpp). If a leg is not free, the cube at its end is excluded, and the search starts again.
// Frame W.   Units: metres.   Pure and deterministic: effort is bounded by counts.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/voxel_search.hpp"

namespace skein::agent {

struct VoxelRouteConfig {
  VoxelSearchConfig search;
  int retries = 3;  ///< further searches, each of which excludes one more cube; chosen
};

/// The path enters no occupied cube, except the one that contains `to_W`.
/// @param claimed  cubes that other UAVs have claimed: the path enters none of them, but may begin in one.
/// @returns corners from the first after `from_W` up to `to_W`; nullopt if there is no path, or none was found.
std::optional<std::vector<Vector3d>> find_voxel_route(const VoxelGrid& grid, const FreeSpace& space,
                                                      const Vector3d& from_W, const Vector3d& to_W,
                                                      const std::set<VoxelGrid::Id>& claimed = {},
                                                      const VoxelRouteConfig& config = {});

/// For each cube, by VoxelGrid::Id: whether a path leads to its centre along free centres of cubes that are not
/// occupied. Claims are ignored. find_voxel_route() may also reach places in cubes adjacent to these.
/// @returns nullopt if `from_W` is outside the grid, or if there are too many such cubes.
std::optional<std::vector<bool>> voxels_in_reach(const VoxelGrid& grid, const FreeSpace& space, const Vector3d& from_W);

}  // namespace skein::agent
