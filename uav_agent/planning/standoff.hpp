// From a strip on a box's face to a line that can be flown: how far off the real surface, and how fast, from
// what the map knows so far. Boxes are loose; the structure may begin many metres behind the face.
// Frame W.   Units: SI.   Pure.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/motion.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

struct StandoffConfig {
  double ratio = 0.92;        ///< distance to the surface, in units of d*
  double blind_ratio = 0.55;  ///< the same off the box's face, where the map knows no surface
  double step_m = 1.5;        ///< along the strip
  double speed_gain = 1.0;    ///< 1: as fast as no blur allows
  double min_speed_mps = 0.5, max_speed_mps = 4.0;
};

/// A stretch of a strip that can be flown in one go.
struct Run {
  std::vector<Waypoint> waypoints;  ///< in the order of flight
  double first_s = 0.0;             ///< where on the strip it begins [m]
};

/// Depth of the surface behind the face at a point of the strip, as the map knows it: the median over the
/// strip's width.
/// @returns nullopt where less than half of the width has been seen.
std::optional<double> surface_depth(const Strip& strip, const Vector3d& on_face_W, const OccupancyMap& map);

/// Lines along the strip, from `from_s` metres on in the direction of flight. Parts that cannot be reached are
/// left out.
/// @param p_W_now  where the UAV is, if it flies this strip already: the line then goes on from there.
std::vector<Run> fit_strip(const Strip& strip, bool reversed, double from_s, const std::optional<Vector3d>& p_W_now,
                           const FreeSpace& space, const CameraReach& reach, const StandoffConfig& config);

}  // namespace skein::agent
