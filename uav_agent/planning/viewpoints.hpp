// Viewpoints: candidates around a target, views of boxes, the targets that are visible from each place, and clusters of
// places in sight of each other.
// Frame W.   Units: SI and radians.   Pure and deterministic.   Effort: candidates times targets, cut by range first.
// Source: cylindrical sampling as in FUEL (STAR's explorer); clusters by distance and mutual visibility as in
// Star-Searcher (STAR's photographers).
#pragma once

#include <vector>

#include "core/types.hpp"
#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

struct RingConfig {
  /// Horizontal distances of the inner and the outer ring from the target. Chosen.
  double inner_m = 4.0, outer_m = 8.0;
  int rings = 3;                          ///< chosen
  int directions = 12;                    ///< on each ring; chosen
  std::vector<double> heights_m = {0.0};  ///< heights of each ring above the target
};

/// Places around a target: ring by ring from the inside, height by height, counter-clockwise from +x (seen from above).
std::vector<Vector3d> ring_around(const Vector3d& target_W, const RingConfig& config);

/// A place beside a box, and the point of the box that is nearest to it.
struct BoxView {
  Vector3d p_W, nearest_W;
};

/// Views of all boxes, box by box and ring by ring from the top down: at the four corners of horizontal rings (in the
/// box's axes), `standoff_m` from the two sides that meet there. There is a ring for each `ring_step_m` of a box's
/// height, at least one.
std::vector<BoxView> rings_around(const std::vector<OrientedBox>& boxes, double standoff_m, double ring_step_m);

struct ViewLimits {
  double range_m = 10.0;  ///< chosen
  /// Half angles of the image [rad]; numeric: pi or more is all around.
  double half_width = 3.2, half_height = 3.2;
};

/// Indices of the targets that are within range and in the image of a camera at `from_W` that looks along yaw and
/// pitch (positive: down), with no occupied cube in between.
std::vector<std::size_t> visible_targets(const VoxelGrid& grid, const Vector3d& from_W, double yaw, double pitch,
                                         const std::vector<Vector3d>& targets_W, const ViewLimits& limits);

/// Groups of places, as indices. The first place without a group begins one; all others without a group join that are
/// within `radius_m` of it and in its sight.
std::vector<std::vector<std::size_t>> visibility_clusters(const VoxelGrid& grid, const std::vector<Vector3d>& places_W,
                                                          double radius_m);

/// Chooses one place for each stop, so that the path from `from_W` through all stops is shortest. Source: FUEL's
/// refinement of the next viewpoints: Dijkstra in a layered graph, here as dynamic programming over the layers.
/// @param options  places by stop; none may be empty.   @returns an index for each stop; ties go to the lower one.
std::vector<std::size_t> shortest_through(const Vector3d& from_W, const std::vector<std::vector<Vector3d>>& options);

}  // namespace skein::agent
