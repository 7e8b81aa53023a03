// What a planner can ask for by way of motion. Frame W.   Units: SI and radians.
#pragma once

#include <variant>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// A point to fly to now: it goes to the flight controller as it is, clamped to the vehicle's limits.
struct Setpoint {
  Vector3d p_WB = Vector3d::Zero();
  double yaw = 0.0;
  Vector3d v_WB = Vector3d::Zero();
  Vector3d a_WB = Vector3d::Zero();
};

struct Waypoint {
  Vector3d p_WB = Vector3d::Zero();
  double speed_mps = 1.0;  ///< not exceeded on the leg that ends here
};

/// A polyline to follow from the present set-point on; replaces any path before. The UAV stops at its end.
struct Path {
  std::vector<Waypoint> waypoints;
};

/// Brake as hard as the limits allow, then stay.
struct Hold {};

/// What the set-point does now. monostate: carry on as told before; before the first motion: motors stay off.
/// A TrajectoryCommand goes to the flight controller as it is, in this exchange and no other: nothing smooths it or
/// keeps it within limits, and parts of it may be left at zero (a velocity without a position, an acceleration alone,
/// yaw alone; docs/rules.md, P1 to P3). After it nothing is sent until the next motion: then the flight controller
/// stays where the last command lapsed. A Path or Hold after it begins where the UAV is, at the velocity that it has.
using Motion = std::variant<std::monostate, Setpoint, Path, Hold, TrajectoryCommand>;

}  // namespace skein::agent
