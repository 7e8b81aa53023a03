// From one place, the best picture of one point: which way a camera should look, and how good that is.
// Frames: W world, C camera.   Units: SI, radians.
#pragma once

#include <functional>

#include "core/camera_quality.hpp"
#include "core/scenario.hpp"
#include "sight/camera_mount.hpp"

namespace skein::sim {

/// Where a camera looks, R_WC = Rz(yaw) Ry(pitch), and the quality that a point then has.
struct Aim {
  double yaw = 0.0, pitch = 0.0;
  double q = 0.0;  ///< 0: the point is too far or too close, or the gimbal cannot show it
};

/// Aims one kind of camera. It stands still; the gimbal limits pitch. The body may have any heading, so yaw is free
/// unless somebody says which headings are not.
/// Turning away from the point can pay: resolution counts depth, which is less towards the border of the picture, and
/// the formula prefers some axes to others (docs/rules.md, S4). Const functions are safe from any thread.
class BestAim {
 public:
  BestAim(const CameraKind& kind, double desired_mm_per_pixel, const RulesConfig& rules);

  /// Searches the picture in which the point may lie: a coarse grid, then ever smaller steps from the best of each
  /// quarter, down to a tenth of a degree. Ends early at q = 1.
  /// @param ray_W    from the camera to the point.   @param n_W  unit normal of the surface.
  /// @param allowed  which headings of the camera are; empty: all.
  Aim find(const Vector3d& ray_W, const Vector3d& n_W, const std::function<bool(double yaw)>& allowed = {}) const;

  /// Farther points are beyond the search radius, or have no quality that counts in whatever corner of the picture
  /// (0.01, where the rules count less) [m].
  double reach() const { return reach_; }

 private:
  struct Try;
  struct Heading;
  Aim look(const Heading& heading, double lift) const;
  Try climb(const Vector3d& ray_W, const Vector3d& n_W, const std::function<bool(double)>& allowed, Try best) const;

  Exposure exposure_;  ///< at the origin, looking along x: what is judged is turned into its frame
  double pitch_limit_, tan_half_hfov_, half_vfov_, reach_;
};

}  // namespace skein::sim
