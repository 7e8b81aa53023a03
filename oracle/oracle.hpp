// What could be had: with full knowledge of the scene, the best picture of every interest point.
// A converged estimate for planners to be measured by, neither a plan nor a bound: no time, no route, no radio, a
// camera that stands still (so no blur), and a search that looks at a finite number of directions.
// Frames: W world, ground z = 0; C camera.   Units: SI, radians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim {

/// What keeps its clearance from the structure.
enum class Berth {
  camera,  ///< the camera, as a point
  body,    ///< a sphere about the body that holds box and rotors
};

struct OracleConfig {
  double clearance_m = 0.5;  ///< of the camera or the body from the structure, and on its way there; >= 0
  /// What can be reached with this berth is outside. Openings less than twice as wide are windows and doors, and
  /// what lies behind them is inside. At least the clearance is used.
  double outside_berth_m = 2.5;
  /// Directions from which each point is looked at before the best of them are refined. The oracle does it once with as
  /// many and once with twice as many, to tell how far it has converged.
  std::size_t directions = 256;
  /// How many threads share the work; the result does not depend on it.
  unsigned threads = 1;
  Berth berth = Berth::camera;
};

/// The best picture of one point that was found: from where, and how R_WC = Rz(yaw) Ry(pitch) is turned.
struct PointView {
  Vector3d p_WC = Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0;
  double q = 0.0;           ///< 0: it cannot be seen
  double gimbal_yaw = 0.0;  ///< part of `yaw` that the gimbal turns; the level body has the rest
  std::size_t kind = 0;     ///< of camera, in the order of camera_kinds()
};

/// Points with q of at least the scenario's `min_point_score`, and the sum of these q.
struct Attainable {
  std::size_t points = 0;
  double score = 0.0;
  bool operator==(const Attainable&) const = default;
};

/// What can be had from one set of places.
struct OracleAnswer {
  std::vector<PointView> best;  ///< by interest point
  Attainable attainable;        ///< of `best`
  Attainable coarse;            ///< with half as many directions
};

struct OracleReport {
  /// From all places that hang together with the open sky or a start (open_space.hpp).
  OracleAnswer reachable;
  /// From those close to what hangs together with a wide berth too; never more than `reachable`.
  OracleAnswer outside;
  /// By interest point: attainable, and with a body that fits there and gets there, touching nothing. Found by a search
  /// of its own with Berth::body and no clearance beyond the body's sphere.
  std::vector<std::uint8_t> flyable;
};

/// A point counts as the referee would have it: in the search radius and the picture, first thing on the ray within
/// the camera's tolerance, quality by the scenario's formula. What keeps the clearance does so all the way; the camera
/// stays above the ground, and pitches as far as its gimbal does. It hangs on a level body that has any heading, and
/// the gimbal turns the rest, so that the body does not hide the point and nothing of the structure is between the
/// body's centre and the camera (both as far as the rules want it). Of several kinds of camera in a fleet each point
/// gets the best.
///
/// Along one direction from the point quality only falls with distance. So the nearest place that is free is the best
/// one there, and it is found to some centimetres; what is searched is the sphere of directions. More of them never
/// lower a q.
/// Depends on nothing but its arguments.
/// @throws std::invalid_argument for a clearance or a number of directions that makes no sense.
OracleReport consult_oracle(const Scenario& scenario, const Scene& scene, const OracleConfig& config);

/// About how long that takes on an ordinary machine that has nothing else to do [s]: from the numbers of points and of
/// grid lines, not from a clock. Pure.
double expected_seconds(const Scenario& scenario, const Scene& scene, const OracleConfig& config);

}  // namespace skein::sim
