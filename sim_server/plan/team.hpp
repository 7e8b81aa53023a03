// The planner's model of the fleet: kinds of UAVs and their motion; and the planner's parameters.
// Frames: W world, ground z = 0; B body.   Units: SI, radians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "sight/camera_mount.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Parameters of the planner. Counts bound its effort, so the plan does not depend on the machine or on `threads`.
struct PlanConfig {
  double margin_m = 0.5;            ///< clearance between the structure and the sphere about the body
  double speed_share = 0.75;        ///< of the vehicle's maximum speed
  double acceleration_share = 0.5;  ///< of the vehicle's maximum acceleration
  double settle_s = 0.1;            ///< rest before a picture
  std::size_t most_seeds = 900;     ///< maximum number of places on the structure for which views are made
  std::size_t most_views = 6000;    ///< maximum number of views that are kept for each kind of UAV
  std::size_t most_nodes = 1500;    ///< maximum number of nodes of the graph of paths around the structure
  std::size_t rounds = 60;          ///< rounds of removing a part of the stops and filling the routes again
  std::uint64_t seed = 1;           ///< of the search; 0 has no special meaning
  unsigned threads = 1;
};

/// UAVs with the same motion, camera and radio.
struct TeamKind {
  VehicleConfig vehicle;
  CameraKind camera;
  BodyShape body;
  double clearance = 0.0;  ///< of the body's centre from the structure [m]
  double speed = 0.0, acceleration = 0.0;

  /// Time from rest to rest along a straight line [s]. Vertical acceleration is limited further, because a UAV with low
  /// thrust has little control of its attitude. Pure. @param way  from beginning to end [m].
  double travel_s(const Vector3d& way) const;
  /// Distance, speed and acceleration along such a line, a time `t` after the beginning [s]. Pure.
  struct Motion {
    double distance = 0.0, speed = 0.0, acceleration = 0.0;
  };
  Motion motion(const Vector3d& way, double t) const;
  double acceleration_along(const Vector3d& way) const;
};

/// The kinds of UAVs in a fleet, and the kind of each UAV. Pure.
struct Team {
  std::vector<TeamKind> kinds;
  std::vector<std::size_t> kind_of;  ///< by UAV

  Team(const Scenario& scenario, const PlanConfig& config);
};

/// Height above the ground of the body's centre at the end of a takeoff [m].
inline constexpr double kTakeoffHeight = 2.0;
/// Least height of the body's centre on paths and at views [m].
inline constexpr double kLeastHeight = 1.2;
/// Time from the first command until a UAV climbs [s].
inline constexpr double kSpinUpS = 0.5;
/// Time at rest after which a camera that triggers by itself has certainly taken a picture [s].
inline constexpr double kPictureS = 0.15;

}  // namespace skein::sim
