// The fleet as the plan with full knowledge sees it: kinds of UAVs, how they move, and what the plan is asked for.
// Frames: W world, ground z = 0; B body.   Units: SI, radians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scenario.hpp"
#include "sight/camera_mount.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Effort is bounded by counts; equal numbers give equal plans, whatever `threads` is.
struct PlanConfig {
  double margin_m = 0.5;            ///< between the structure and a sphere about the body, at views and on the way
  double speed_share = 0.75;        ///< of the greatest speed that a vehicle may be commanded
  double acceleration_share = 0.5;  ///< likewise of its acceleration
  double settle_s = 0.1;            ///< at rest before a picture
  std::size_t most_seeds = 900;     ///< places on the structure that views are made for
  std::size_t most_views = 6000;    ///< that are kept, by kind of UAV
  std::size_t most_nodes = 1500;    ///< of the graph of ways around the structure
  std::size_t rounds = 60;          ///< of taking a part of the routes apart and filling them again
  std::uint64_t seed = 1;           ///< of the search; 0 is a seed like the others
  unsigned threads = 1;
};

/// UAVs that move, see and send alike.
struct TeamKind {
  VehicleConfig vehicle;
  CameraKind camera;
  BodyShape body;
  double clearance = 0.0;  ///< of the body's centre from the structure [m]
  double speed = 0.0, acceleration = 0.0;

  /// From rest to rest along a straight line [s]. Up and down takes longer: a UAV whose rotors hardly pull has little
  /// hold on its attitude. Pure.
  double travel_s(const Vector3d& way) const;
  /// Where a UAV is a time after it left on such a line: distance, speed, and acceleration along it. Pure.
  struct Motion {
    double distance = 0.0, speed = 0.0, acceleration = 0.0;
  };
  Motion motion(const Vector3d& way, double t) const;
  double acceleration_along(const Vector3d& way) const;
};

/// Kinds, and whose kind is which, in fleet order. Pure.
struct Team {
  std::vector<TeamKind> kinds;
  std::vector<std::size_t> kind_of;  ///< by UAV

  Team(const Scenario& scenario, const PlanConfig& config);
};

/// Where a UAV ends its take-off: above its start [m].
inline constexpr double kTakeoffHeight = 2.0;
/// The lowest place of a body's centre that is used on the way and at views [m].
inline constexpr double kLeastHeight = 1.2;
/// From the first command until a UAV climbs [s].
inline constexpr double kSpinUpS = 0.5;
/// From rest in place until a camera that triggers itself has surely taken a picture [s].
inline constexpr double kPictureS = 0.15;

}  // namespace skein::sim
