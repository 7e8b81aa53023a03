// The mount of a camera: where the body is for a given camera position, and which rays the body blocks. For the oracle,
// and for plans and viewpoints in sim_server. The body hovers, level and at rest. The camera's heading is the body's
// heading plus the gimbal's yaw, so many body headings are possible for one camera heading.
// Frames: W world, B body, C camera.   Units: SI, radians.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "sight/ray_shapes.hpp"

namespace skein::sim {

/// A camera, the gimbal that turns it, and the body that carries both.
struct CameraKind {
  CameraConfig camera;
  GimbalConfig gimbal;
  BodyShape body;

  /// The parameters that decide which pictures the camera can take from a place if the body may have any heading.
  std::array<double, 5> optics() const;
  /// All parameters that matter to a camera at rest; cameras with equal parameters are of the same kind.
  std::vector<double> essence() const;
};

/// The kinds of camera in a fleet, each once, in fleet order. Pure.
std::vector<CameraKind> camera_kinds(const Scenario& scenario);

/// A set of allowed body headings, out of 36 that are 10 degrees apart.
struct BodyHeadings {
  static constexpr std::size_t kCount = 36;
  double first = 0.0;  ///< yaw of heading 0 [rad]
  std::bitset<kCount> allowed;

  double yaw(std::size_t i) const;
};

/// Immutable; all calls are safe from any thread.
class CameraMount {
 public:
  /// @param body_hides  false: the camera looks through its own body (`rules.own_body_hides`).
  CameraMount(const CameraKind& kind, bool body_hides);

  /// The body headings with which the body does not block a ray from its camera; heading 0 is the azimuth of the ray.
  BodyHeadings clear_headings(const Vector3d& ray_W) const;

  /// Index of the allowed body heading that needs the least gimbal yaw for this camera heading; nullopt when each needs
  /// more than the gimbal's limit.
  std::optional<std::size_t> nearest_heading(const BodyHeadings& headings, double camera_yaw) const;

  /// Centre (origin) of the body in W when the camera is at p_WC and the body has this yaw.
  Vector3d body_centre(const Vector3d& p_WC, double body_yaw) const;
  /// Mean of body_centre() over all yaws: on the vertical through the camera. Each body_centre() is arm() away from it.
  Vector3d mean_centre(const Vector3d& p_WC) const { return {p_WC.x(), p_WC.y(), p_WC.z() - p_BC_.z()}; }
  double arm() const { return p_BC_.head<2>().norm(); }  ///< horizontal distance, camera to centre
  double offset() const { return p_BC_.norm(); }         ///< distance, camera to centre
  double body_radius() const { return body_.radius; }    ///< of a sphere about the centre that contains box and rotors

 private:
  Vector3d p_BC_;
  Body body_;
  bool body_hides_;
  double yaw_limit_;
};

}  // namespace skein::sim
