// From one place to another by the cubes of a voxel grid, as corners that can be flown: straight where nothing is in
// the way; else A* through the graph, shortened where a short cut is free, too. What the graph takes to be free is
// checked against the finer map (free_space.hpp); a cube that fails is left out, and the search begins again.
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
  int retries = 3;  ///< with another cube left out each time
};

/// @param claimed  cubes that are taken: none of them is entered, but the one that the way begins in may be left.
/// @returns corners from the first after `from_W` up to `to_W`; nullopt if there is no way or none was found with that
/// effort. Occupied cubes are not entered, but for the one of `to_W`.
std::optional<std::vector<Vector3d>> find_voxel_route(const VoxelGrid& grid, const FreeSpace& space,
                                                      const Vector3d& from_W, const Vector3d& to_W,
                                                      const std::set<VoxelGrid::Id>& claimed = {},
                                                      const VoxelRouteConfig& config = {});

/// The cubes to which find_voxel_route() finds a way, as far as their middles tell: the way to a place in a cube
/// beside them may be free, too.
/// @returns nullopt outside the grid, or if they are too many to say.
std::optional<std::vector<bool>> voxels_in_reach(const VoxelGrid& grid, const FreeSpace& space, const Vector3d& from_W);

}  // namespace skein::agent
