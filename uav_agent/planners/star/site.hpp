// What STAR derives from the boxes alone: the grid of the site, the cubes of each team, and places beside the boxes;
// and the configurations of its parts, from its parameters.
// Frame W.   Units: metres.   Pure.
#pragma once

#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/star/config.hpp"
#include "uav_agent/planners/star/explorer.hpp"
#include "uav_agent/planners/star/surfaces.hpp"

namespace skein::agent {

/// A grid over all boxes and the space around them from which their faces are photographed. Cubes have the size in
/// `config`, or larger if there were more than max_voxels.
/// @param sharp_m  d*.
VoxelGrid star_grid(const std::vector<OrientedBox>& boxes, const StarConfig& config, double sharp_m);

/// The cubes whose box is one of `own_boxes`. The box of a cube is the first one that its middle is in, or within half
/// a cube of.
std::vector<VoxelGrid::Id> cubes_of_boxes(const VoxelGrid& grid, const std::vector<OrientedBox>& boxes,
                                          const std::vector<std::size_t>& own_boxes);

/// Free places beside a box, in a circle around it at half its height, the one nearest to `p_W` first.
std::vector<Vector3d> places_beside(const OrientedBox& box, const FreeSpace& space, const Vector3d& p_W);

/// @param sharp_m  d*.
StarSurfaces::Config surfaces_config(const StarConfig& config, const VehicleConfig& vehicle, double sharp_m);
StarExplorer::Config explorer_config(const StarConfig& config);

}  // namespace skein::agent
