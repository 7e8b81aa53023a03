// Converts a strip on a box's face into lines that a UAV can fly: positions and speeds by the distance to the real
// surface, as far as the map knows it. Boxes are loose: the structure may begin many metres behind the face.
// Frame W.   Units: SI.   Pure.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

struct StandoffConfig {
  double ratio = 0.92;        ///< distance to the surface, in units of d* (CameraReach::sharp_distance_m); chosen
  double blind_ratio = 0.55;  ///< the same to the box's face where the map knows no surface; chosen
  double step_m = 1.5;        ///< between waypoints, along the strip; chosen
  double speed_gain = 1.0;    ///< in units of the greatest speed without blur; chosen
  double min_speed_mps = 0.5, max_speed_mps = 4.0;  ///< chosen
};

/// A stretch of a strip that can be flown in one go.
struct Run {
  std::vector<Waypoint> waypoints;  ///< in the order of flight
  double first_s = 0.0;             ///< its beginning: distance along the strip in the direction of flight [m]
};

/// Depth of the surface behind the face at a point of the strip, by the map [m]: the median over five rays across the
/// strip's width; negative in front of the face.
/// @returns nullopt if fewer than three of the rays hit a surface.
std::optional<double> surface_depth(const Strip& strip, const Vector3d& on_face_W, const OccupancyMap& map);

/// Lines along the strip, from `from_s` metres on in the direction of flight. Parts that cannot be flown are left out.
/// @param reversed  whether the UAV flies from the strip's end to its beginning.
/// @param p_W_now  the UAV's position, if it flies this strip already: the first line then continues from there.
std::vector<Run> fit_strip(const Strip& strip, bool reversed, double from_s, const std::optional<Vector3d>& p_W_now,
                           const FreeSpace& space, const CameraReach& reach, const StandoffConfig& config);

}  // namespace skein::agent
