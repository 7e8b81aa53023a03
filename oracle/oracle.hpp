// The oracle: with full knowledge of the scene, the best picture of every interest point.
// The result is a converged estimate to compare planners with, neither a plan nor a bound: it ignores time, routes and
// radio, the camera is at rest (so there is no blur), and the search tries a finite number of directions.
// Frames: W world, ground z = 0; C camera.   Units: SI, radians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

/// The object to which the clearance from the structure applies.
enum class Berth {
  camera,  ///< to the camera, as a point
  body,    ///< to a sphere around the body that contains box and rotors
};

struct OracleConfig {
  double clearance_m = 0.5;  ///< of the camera or the body from the structure, also on the way to its place; >= 0
  /// Clearance that defines `outside`: the places that can be reached with it. Openings less than twice as wide count
  /// as windows and doors, and places behind them as inside. Has no effect below the clearance that is needed anyway.
  double outside_berth_m = 2.5;
  /// Directions from which the oracle looks at each point before it refines the best of them; >= 1. It searches once
  /// with this number and once with twice the number, to measure the convergence.
  std::size_t directions = 256;
  /// Number of threads; the result does not depend on it.
  unsigned threads = 1;
  Berth berth = Berth::camera;
};

/// The best picture of one point that the search has found: camera position, and orientation R_WC = Rz(yaw) Ry(pitch).
struct PointView {
  Vector3d p_WC = Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0;
  double q = 0.0;           ///< quality; 0: the point cannot be seen
  double gimbal_yaw = 0.0;  ///< the gimbal's part of `yaw`; the rest is the heading of the level body
  std::size_t kind = 0;     ///< index of the camera's kind in camera_kinds()
};

/// Number of points with a q of at least the scenario's `min_point_score`, and the sum of these q.
struct Attainable {
  std::size_t points = 0;
  double score = 0.0;
  bool operator==(const Attainable&) const = default;
};

/// The result for one set of camera places.
struct OracleAnswer {
  std::vector<PointView> best;  ///< by interest point
  Attainable attainable;        ///< of `best`
  Attainable coarse;            ///< with half as many directions
};

struct OracleReport {
  /// From all places in open space with the clearance (open_space.hpp).
  OracleAnswer reachable;
  /// From those places that are also next to open space with `outside_berth_m`; never more than `reachable`.
  OracleAnswer outside;
  /// By interest point: 1 if the point is attainable, and a whole UAV fits and gets there without touching anything.
  /// Found by a separate search with Berth::body and no clearance beyond the body's sphere.
  std::vector<std::uint8_t> flyable;
};

/// Finds the best picture of every interest point. A point counts as it does in flight (sight/camera.hpp): it lies
/// within the search radius and the field of view, the camera has line of sight to it, and the scenario's formula gives
/// the quality. The camera or the body keeps the clearance, also on its way; the camera stays above the ground, with a
/// pitch within the gimbal's limit. The level body may have any heading (in steps of 10 degrees), and the gimbal turns
/// by the remainder. If the rules demand it, the body must not occlude the point, and no structure may be between the
/// body's centre and the camera. If a fleet has several kinds of camera, each point gets the best quality of them all.
///
/// In one direction from the point, quality only falls with distance. So the nearest free place is the best one in this
/// direction; it is found with an error of some centimetres. The search is over the sphere of directions; more of them
/// never lower a q.
/// Depends on nothing but its arguments.
/// @throws std::invalid_argument if the clearance is negative or not finite, or the number of directions is 0.
OracleReport consult_oracle(const Scenario& scenario, const Scene& scene, const OracleConfig& config);

/// Estimate of the time that consult_oracle() takes on an ordinary, idle machine [s], from the numbers of points,
/// directions, grid lines and threads. Pure.
double expected_seconds(const Scenario& scenario, const Scene& scene, const OracleConfig& config);

}  // namespace skein::sim
