// Path search through free space: weighted A* on a lattice; then short cuts that are free shorten the path.
// Frame W.   Units: metres.   Pure and deterministic: effort is bounded by a count of expanded cells.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

struct PathSearchConfig {
  double cell_m = 2.0;        ///< spacing of the lattice; chosen
  int max_expansions = 6000;  ///< chosen: bounds the CPU time
  double heuristic = 1.2;     ///< weight of the heuristic: the cost may be this many times the least; chosen
  /// The search stays in the bounding box of start, goal and structure, grown by this. Chosen.
  double margin_m = 25.0;
};

/// If the start is not free (something new was seen near it), the path begins with a straight way out to the nearest
/// free cell, see FreeSpace::leads_out().
/// @param structure  boxes that the path may have to go around.
/// @param gave_up  optional: set to true if there may be a path, but the search ended after max_expansions; else false.
/// @returns corners from the first after `from_W` up to `to_W`; nullopt if there is no path, or none was found.
std::optional<std::vector<Vector3d>> find_path(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                               const Vector3d& from_W, const Vector3d& to_W,
                                               const PathSearchConfig& config = {}, bool* gave_up = nullptr);

/// For a goal that cannot be reached: a path to the reachable lattice point that is nearest to it.
/// @param worth_m  least decrease of the distance to the goal that is worth a path.
/// @returns corners as above; nullopt if no such point was found.
std::optional<std::vector<Vector3d>> find_approach(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                                   const Vector3d& from_W, const Vector3d& to_W, double worth_m,
                                                   const PathSearchConfig& config = {});

/// A path through all of these places, at one speed.
Path path_through(const std::vector<Vector3d>& places_W, double speed_mps);

/// Length of the polyline from `from_W` through all corners [m].
double path_length(const Vector3d& from_W, const std::vector<Vector3d>& corners_W);

}  // namespace skein::agent
