// From one place, the best picture of one point: which way a camera should look, and how good that is.
// Frames: W world, C camera.   Units: SI, radians.
#pragma once

#include <array>
#include <vector>

#include "core/camera_quality.hpp"
#include "core/scenario.hpp"

namespace skein::sim {

/// A camera and the gimbal that carries it.
struct CameraKind {
  CameraConfig camera;
  GimbalConfig gimbal;

  /// All that matters to a camera that stands still.
  std::array<double, 5> essence() const;
};

/// The kinds of camera in a fleet, each once, in fleet order. Pure.
std::vector<CameraKind> camera_kinds(const Scenario& scenario);

/// Where a camera looks, R_WC = Rz(yaw) Ry(pitch), and the quality that a point then has.
struct Aim {
  double yaw = 0.0, pitch = 0.0;
  double q = 0.0;  ///< 0: the point is too far or too close, or the gimbal cannot show it
};

/// Aims one kind of camera. The body stands still and may have any heading, so yaw is free; the gimbal limits pitch.
/// Turning away from the point can pay: resolution counts depth, which is less towards the border of the picture, and
/// the formula prefers some axes to others (docs/rules.md, S4). Const functions are safe from any thread.
class BestAim {
 public:
  BestAim(const CameraKind& kind, double desired_mm_per_pixel, const RulesConfig& rules);

  /// Searches the picture in which the point may lie: a coarse grid, then ever smaller steps from the best of each
  /// quarter, down to a tenth of a degree. Ends early at q = 1.
  /// @param ray_W  from the camera to the point.   @param n_W  unit normal of the surface.
  Aim find(const Vector3d& ray_W, const Vector3d& n_W) const;

  /// Farther points are beyond the search radius, or have no quality that counts in whatever corner of the picture
  /// (0.01, where the rules count less) [m].
  double reach() const { return reach_; }

 private:
  struct Try;
  struct Heading;
  Aim look(const Heading& heading, double lift) const;
  Try climb(const Vector3d& ray_W, const Vector3d& n_W, Try best) const;

  Exposure exposure_;  ///< at the origin, looking along x: what is judged is turned into its frame
  double pitch_limit_, tan_half_hfov_, half_vfov_, reach_;
};

}  // namespace skein::sim
