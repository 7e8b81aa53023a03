// A path through free space: A* on a lattice, then shortened by taking every short cut that is free.
// Frame W.   Units: metres.   Pure and deterministic: effort is bounded by a count of expanded cells.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

struct PathSearchConfig {
  double cell_m = 2.0;
  int max_expansions = 6000;
  double heuristic = 1.2;  ///< a path at most this much longer than the best is good enough
  double margin_m = 25.0;  ///< the search stays in the box around start, goal and all structure, widened by this
};

/// @param structure  boxes that the search may have to go around.
/// @returns corners from the first after `from_W` up to `to_W`, or nullopt if there is no path or none was
/// found in time.          A start that is not free itself (something new was seen near by) is left by the
/// nearest way.
/// @param gave_up  if given, becomes true when there may be a path, but the search ended after max_expansions.
std::optional<std::vector<Vector3d>> find_path(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                               const Vector3d& from_W, const Vector3d& to_W,
                                               const PathSearchConfig& config = {}, bool* gave_up = nullptr);

/// The same to the place, of those that can be reached, that is nearest to a goal which cannot.
/// @param worth_m  by less than this it is not worth the way: nullopt.
std::optional<std::vector<Vector3d>> find_approach(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                                   const Vector3d& from_W, const Vector3d& to_W, double worth_m,
                                                   const PathSearchConfig& config = {});

/// Through all of these places, at one speed.
Path path_through(const std::vector<Vector3d>& places_W, double speed_mps);

/// Length of the polyline from `from_W` through all corners [m].
double path_length(const Vector3d& from_W, const std::vector<Vector3d>& corners_W);

}  // namespace skein::agent
