// The motions that a planner can request. Frame W.   Units: SI and radians.
#pragma once

#include <variant>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// A setpoint for the flight controller, sent without smoothing in every exchange until the next motion. Only velocity
/// and acceleration are clamped, to the tracker's limits (flight_core/tracker.hpp).
struct Setpoint {
  Vector3d p_WB = Vector3d::Zero();
  double yaw = 0.0;
  Vector3d v_WB = Vector3d::Zero();
  Vector3d a_WB = Vector3d::Zero();
};

struct Waypoint {
  Vector3d p_WB = Vector3d::Zero();
  double speed_mps = 1.0;  ///< maximum speed on the leg that ends here; chosen
};

/// A polyline to follow from the present setpoint on; it replaces any earlier path. The UAV stops at its end.
struct Path {
  std::vector<Waypoint> waypoints;
};

/// Brake as hard as the tracker's limits allow, then hover.
struct Hold {};

/// The requested motion. monostate: the last motion continues; before the first motion, the motors stay off.
/// The agent sends a TrajectoryCommand to the flight controller unchanged, in this exchange only, without smoothing or
/// limits. Parts of it may be zero, which means "none": a velocity without a position, an acceleration alone, yaw alone
/// (docs/rules.md, P1 to P3). Afterwards the agent sends nothing until the next motion. Once the command has expired,
/// the flight controller holds the position. A later Path or Hold begins at the UAV's present position and velocity.
using Motion = std::variant<std::monostate, Setpoint, Path, Hold, TrajectoryCommand>;

}  // namespace skein::agent
