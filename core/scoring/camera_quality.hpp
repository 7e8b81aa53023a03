// Quality with which one exposure shows a surface point: field of view, motion blur, resolution (q_blur, q_res).
// The camera sits on a gimbal that removes roll and pitch of the body.
// Frames: W world (ENU), B body (FLU), C camera (x optical axis, y left, z up).  Units: SI, radians; mm per pixel
// where the name says so.  Source: CARIC, the sections on blur and resolution; the contest's formulas in docs/rules.md.
#pragma once

#include <algorithm>
#include <optional>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein {

/// The step along the surface by which the resolution is measured.
enum class ResolutionRule {
  contest,  ///< as the organisers' code has it: shorter than 1 mm where the normal leans out of the step's plane
  paper,    ///< 1 mm always
};

/// Pose and motion of the camera at one instant.
struct CameraState {
  Isometry3d X_WC = Isometry3d::Identity();
  Vector3d v_WC = Vector3d::Zero();  ///< velocity of the camera's origin in W [m/s]
  Vector3d w_WC = Vector3d::Zero();  ///< angular velocity of C in W, expressed in W [rad/s]
};

/// All results of the formulas for one point. In pixel_move, u is the vertical axis and v the horizontal one; in
/// mm_per_pixel it is the other way round (the reference's names). An optional is empty where a formula has no result.
struct PointQuality {
  Vector3d p_C = Vector3d::Zero();  ///< the point in the camera frame [m]
  bool in_search_radius = false;
  bool in_fov = false;
  double pixel_move_u = 0.0, pixel_move_v = 0.0;         ///< motion during the exposure [pixel]; valid if in_fov
  double q_blur = 0.0;                                   ///< [0, 1]; valid if in_fov
  std::optional<double> mm_per_pixel_u, mm_per_pixel_v;  ///< empty: not in the field of view, or too close to resolve
  std::optional<double> q_res;                           ///< [0, 1]
  std::optional<double> score;                           ///< q_blur * q_res, before any threshold
};

/// The two qualities of a point that the camera sees. Never NaN: a quality that the formulas leave undefined is 0.
struct PointScore {
  double q_blur = 0.0, q_res = 0.0;
  /// q_res of a surface that is parallel to the image plane, at the point's depth; in (0, 1]. The quotient
  /// q_res / q_distance is the effect of the surface's tilt. It can exceed 1: the formula prefers some axes (S4).
  double q_distance = 0.0;
  double score() const { return q_blur * q_res; }
};

/// Distance [m] from which on points are ignored: that of the corner of the field of view at
/// resolution_distance(), plus 5 m. As in the organisers' code, the formula uses the tangent of half the vertical
/// field of view, but 1/cosine of half the horizontal one. Pure.
/// @param desired_mm_per_pixel  > 0.
double search_radius(const CameraConfig& camera, double desired_mm_per_pixel);

/// Distance at which a wall that is parallel to the image plane has just the desired resolution [m]. Pure.
double resolution_distance(const CameraConfig& camera, double desired_mm_per_pixel);

/// Pose and motion of the camera. Roll and pitch of the body move the camera's position, but do not rotate its view:
/// R_WC = Rz(yaw of body) Rz(gimbal yaw) Ry(gimbal pitch). Pure.
/// @param body  pitch must not be +-pi/2, where yaw rate has no meaning.
CameraState camera_state(const RigidBodyState& body, const GimbalState& gimbal, const CameraConfig& camera);

/// One exposure, ready to judge many points: everything that does not depend on the point is computed once.
/// Allocates nothing; const functions are safe from any thread.
class Exposure {
 public:
  /// With the organisers' search radius.
  Exposure(const CameraState& state, const CameraConfig& camera, double desired_mm_per_pixel, ResolutionRule rule);
  /// With the resolution rule and search radius that a scenario's rules select; the radius may be infinite.
  Exposure(const CameraState& state, const CameraConfig& camera, double desired_mm_per_pixel, const RulesConfig& rules);

  /// The point in the camera frame, if it lies in the field of view (borders included) and within the search
  /// radius (border excluded).
  std::optional<Vector3d> view(const Vector3d& p_W) const;

  /// Quality of a point that view() returned; nullopt if the point is too close to resolve, or not in front of the
  /// camera.
  /// @param n_W  unit normal of the surface; its sign does not matter.
  std::optional<PointScore> score(const Vector3d& p_C, const Vector3d& n_W) const;

  /// Every intermediate value, for audits and reference vectors.
  PointQuality evaluate(const Vector3d& p_W, const Vector3d& n_W) const;

  double radius() const { return radius_; }
  const Vector3d& position() const { return p_WC_; }

 private:
  struct PixelPair {
    double u = 0.0, v = 0.0;
  };
  Vector3d to_camera(const Vector3d& p_W) const { return R_CW_ * (p_W - p_WC_); }
  bool in_fov(const Vector3d& p_C) const;
  PixelPair pixel_move(const Vector3d& p_C) const;
  std::optional<PixelPair> mm_per_pixel(const Vector3d& p_C, const Vector3d& n_W) const;
  double blur_quality(const PixelPair& move) const;
  double resolution_quality(const PixelPair& mm) const;
  double distance_quality(double depth) const { return std::min(1.0, resolution_distance_ / depth); }

  Matrix3d R_CW_;
  Vector3d p_WC_, v_C_, w_C_;  ///< velocity and angular velocity of the camera, expressed in C
  double pixels_per_slope_;    ///< f / s
  double tan_half_hfov_, tan_half_vfov_;
  double exposure_s_;
  double radius_;
  double desired_mm_per_pixel_;
  double resolution_distance_;  ///< of the desired resolution
  ResolutionRule rule_;
};

}  // namespace skein
