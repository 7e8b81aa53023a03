// The best picture of one point from one place: the direction in which a camera should look, and the quality.
// Frames: W world, C camera.   Units: SI, radians.
#pragma once

#include <functional>

#include "core/scenario/scenario.hpp"
#include "core/scoring/camera_quality.hpp"
#include "sight/camera_mount.hpp"

namespace skein::sim {

/// Orientation of a camera, R_WC = Rz(yaw) Ry(pitch), and the quality that a point then has.
struct Aim {
  double yaw = 0.0, pitch = 0.0;
  double q = 0.0;  ///< 0: the point is too far or too close, or no allowed orientation shows it
};

/// Aims one kind of camera, which is at rest. The gimbal limits the pitch. The body may have any heading, so the
/// camera's yaw is free, unless the caller of find() restricts it.
/// The best aim need not be straight at the point: resolution depends on depth, which is less towards the border of the
/// picture, and the formula prefers some axes to others (docs/rules.md, S4). Const functions are safe from any thread.
class BestAim {
 public:
  BestAim(const CameraKind& kind, double desired_mm_per_pixel, const RulesConfig& rules);

  /// Searches the places in the picture where the point may appear: first a coarse grid, then, from the best aim in
  /// each quarter of the picture, ever smaller steps, down to a tenth of a degree. Ends early at q = 1.
  /// @param ray_W    from the camera to the point [m].   @param n_W  unit normal of the surface.
  /// @param allowed  whether the camera may have a heading; empty: any heading.
  Aim find(const Vector3d& ray_W, const Vector3d& n_W, const std::function<bool(double yaw)>& allowed = {}) const;

  /// From this distance on [m], a point is outside the search radius, or its quality is less than the rules'
  /// `min_point_score` (at least 0.01), wherever it appears in the picture.
  double reach() const { return reach_; }

 private:
  struct Try;
  struct Heading;
  Aim look(const Heading& heading, double lift) const;
  Try climb(const Vector3d& ray_W, const Vector3d& n_W, const std::function<bool(double)>& allowed, Try best) const;

  Exposure exposure_;  ///< of a camera at the origin that looks along x; points are turned into its frame
  double pitch_limit_, tan_half_hfov_, half_vfov_, reach_;
};

}  // namespace skein::sim
