// What carries a camera: where the body is when its camera is somewhere, and what it hides. Part of the oracle.
// The body stands still and level. The camera's heading is the body's and the gimbal's yaw together, so one heading of
// the camera leaves many to the body.
// Frames: W world, B body, C camera.   Units: SI, radians.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/scenario.hpp"
#include "sight/ray_shapes.hpp"

namespace skein::sim {

/// A camera, the gimbal that turns it, and the body that both hang from.
struct CameraKind {
  CameraConfig camera;
  GimbalConfig gimbal;
  BodyShape body;

  /// All that decides which pictures it can take from a place, however the body is turned.
  std::array<double, 5> optics() const;
  /// All that matters to a camera that stands still.
  std::vector<double> essence() const;
};

/// The kinds of camera in a fleet, each once, in fleet order. Pure.
std::vector<CameraKind> camera_kinds(const Scenario& scenario);

/// Headings that a body may have: every tenth degree from some first one.
struct BodyHeadings {
  static constexpr std::size_t kCount = 36;
  double first = 0.0;
  std::bitset<kCount> allowed;

  double yaw(std::size_t i) const;
};

/// Immutable; safe from any thread.
class CameraMount {
 public:
  /// @param body_hides  false: the camera looks through its own body (`rules.own_body_hides`).
  CameraMount(const CameraKind& kind, bool body_hides);

  /// The headings with which the body is not in the way of a ray from its camera, counted from the azimuth of the ray.
  BodyHeadings clear_headings(const Vector3d& ray_W) const;

  /// The allowed heading of the body that turns the gimbal least when the camera has a heading; nullopt when none is
  /// within the gimbal's limit.
  std::optional<std::size_t> nearest_heading(const BodyHeadings& headings, double camera_yaw) const;

  /// Centre of the body whose camera is at a place.
  Vector3d body_centre(const Vector3d& p_WC, double body_yaw) const;
  /// Where the centre would be if the camera hung straight below it; by whatever heading it is `arm()` away from there.
  Vector3d mean_centre(const Vector3d& p_WC) const { return {p_WC.x(), p_WC.y(), p_WC.z() - p_BC_.z()}; }
  double arm() const { return p_BC_.head<2>().norm(); }
  double offset() const { return p_BC_.norm(); }       ///< camera to centre
  double body_radius() const { return body_.radius; }  ///< of a sphere about the centre that holds box and rotors

 private:
  Vector3d p_BC_;
  Body body_;
  bool body_hides_;
  double yaw_limit_;
};

}  // namespace skein::sim
