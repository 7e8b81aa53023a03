// Places to look from: candidates around a target, what can be seen from each, and clusters of places that see each
// other.
// Frame W.   Units: SI and radians.   Pure and deterministic.   Effort: candidates times targets, cut by range first.
// Source: cylindrical sampling as in FUEL (STAR's explorer); clusters by distance and mutual visibility as in
// Star-Searcher (STAR's photographers).
#pragma once

#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

struct RingConfig {
  double inner_m = 4.0, outer_m = 8.0;  ///< radii of the cylinder's rings, horizontally from the target
  int rings = 3;
  int directions = 12;                    ///< on each ring
  std::vector<double> heights_m = {0.0};  ///< above the target
};

/// Places on the rings around a target, ring by ring from the inside, each from +x to the left.
std::vector<Vector3d> ring_around(const Vector3d& target_W, const RingConfig& config);

struct ViewLimits {
  double range_m = 10.0;
  /// Half angles of what is in the image, about the direction to its centre; pi: all around.
  double half_width = 3.2, half_height = 3.2;
};

/// Indices of the targets that are within range and in the image of a camera at `from_W` that looks along yaw and
/// pitch (positive: down), with no occupied cube in between.
std::vector<std::size_t> visible_targets(const VoxelGrid& grid, const Vector3d& from_W, double yaw, double pitch,
                                         const std::vector<Vector3d>& targets_W, const ViewLimits& limits);

/// Groups of places, as indices: the first that is left begins a group, and those within `radius_m` that it sees join.
std::vector<std::vector<std::size_t>> visibility_clusters(const VoxelGrid& grid, const std::vector<Vector3d>& places_W,
                                                          double radius_m);

/// Greedy set cover: takes the candidate that sees most of what nobody has taken yet, until none sees `min_gain` more.
/// @param seen  indices of targets, by candidate.   @returns candidates in the order of choice; ties to the lower one.
std::vector<std::size_t> cover(const std::vector<std::vector<std::size_t>>& seen, std::size_t targets,
                               std::size_t min_gain);

/// One place of several at each stop, so that the way from `from_W` through all stops is shortest. (FUEL's refinement
/// of the next viewpoints: Dijkstra in a graph of layers, which comes to going through them one by one.)
/// @param options  places by stop; none may be empty.   @returns an index for each stop; ties go to the lower one.
std::vector<std::size_t> shortest_through(const Vector3d& from_W, const std::vector<std::vector<Vector3d>>& options);

}  // namespace skein::agent
