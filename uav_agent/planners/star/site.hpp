// What STAR knows of the site before it has seen anything: its cubes, whose they are, and places beside the boxes; and
// what its parameters come to for its parts.
// Frame W.   Units: metres.   Pure.
#pragma once

#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/star/config.hpp"
#include "uav_agent/planners/star/explorer.hpp"
#include "uav_agent/planners/star/surfaces.hpp"

namespace skein::agent {

/// A grid over all boxes with room around them to look at their faces from, with cubes as small as the parameters say.
/// @param sharp_m  d*.
VoxelGrid star_grid(const std::vector<OrientedBox>& boxes, const StarConfig& config, double sharp_m);

/// The cubes of a team, by the box that they are in (the first that holds their middle).
std::vector<VoxelGrid::Id> cubes_of_boxes(const VoxelGrid& grid, const std::vector<OrientedBox>& boxes,
                                          const std::vector<std::size_t>& own_boxes);

/// Places to look at a box from, beside it at half its height, the one nearest to `p_W` first.
std::vector<Vector3d> places_beside(const OrientedBox& box, const FreeSpace& space, const Vector3d& p_W);

/// @param sharp_m  d*.
StarSurfaces::Config surfaces_config(const StarConfig& config, const VehicleConfig& vehicle, double sharp_m);
StarExplorer::Config explorer_config(const StarConfig& config);

}  // namespace skein::agent
