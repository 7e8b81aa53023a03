#include "core/scoring/camera_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/euler.hpp"

namespace skein {
namespace {

constexpr double kMetresPerMm = 0.001;
/// Half a degree in radians, truncated as in the reference; this changes the radius by about 8 nm.
constexpr double kHalfDegree = 0.00872664625;
constexpr double kRadiusMargin = 5.0;
/// Half the step along the surface [m].
constexpr double kHalfStep = 0.0005;

}  // namespace

double resolution_distance(const CameraConfig& camera, double desired_mm_per_pixel) {
  return camera.focal_length_m / camera.pixel_size_m * kMetresPerMm * desired_mm_per_pixel;
}

double search_radius(const CameraConfig& camera, double desired_mm_per_pixel) {
  const double distance = resolution_distance(camera, desired_mm_per_pixel);
  return std::hypot(distance / std::cos(camera.hfov_deg * kHalfDegree),
                    distance * std::tan(camera.vfov_deg * kHalfDegree)) +
         kRadiusMargin;
}

CameraState camera_state(const RigidBodyState& body, const GimbalState& gimbal, const CameraConfig& camera) {
  const Matrix3d R_WB = body.q_WB.toRotationMatrix();
  const RollPitchYaw rpy = roll_pitch_yaw(R_WB);
  const Matrix3d R_WY = rotation_z(rpy.yaw + gimbal.yaw);  // after both yaws, before the gimbal's pitch
  const Vector3d& w = body.w_WB_B;
  const double body_yaw_rate = (std::sin(rpy.roll) * w.y() + std::cos(rpy.roll) * w.z()) / std::cos(rpy.pitch);

  CameraState state;
  state.X_WC.linear() = R_WY * rotation_y(gimbal.pitch);
  state.X_WC.translation() = body.p_WB + R_WB * camera.p_BC;
  state.v_WC = body.v_WB + R_WB * w.cross(camera.p_BC);
  state.w_WC = (body_yaw_rate + gimbal.yaw_rate) * Vector3d::UnitZ() + gimbal.pitch_rate * R_WY.col(1);
  return state;
}

Exposure::Exposure(const CameraState& state, const CameraConfig& camera, double desired_mm_per_pixel,
                   ResolutionRule rule)
    : R_CW_(state.X_WC.linear().transpose()),
      p_WC_(state.X_WC.translation()),
      v_C_(R_CW_ * state.v_WC),
      w_C_(R_CW_ * state.w_WC),
      pixels_per_slope_(camera.focal_length_m / camera.pixel_size_m),
      tan_half_hfov_(std::tan(0.5 * camera.hfov_deg * kRadPerDeg)),
      tan_half_vfov_(std::tan(0.5 * camera.vfov_deg * kRadPerDeg)),
      exposure_s_(camera.exposure_s),
      radius_(search_radius(camera, desired_mm_per_pixel)),
      desired_mm_per_pixel_(desired_mm_per_pixel),
      resolution_distance_(resolution_distance(camera, desired_mm_per_pixel)),
      rule_(rule) {}

Exposure::Exposure(const CameraState& state, const CameraConfig& camera, double desired_mm_per_pixel,
                   const RulesConfig& rules)
    : Exposure(state, camera, desired_mm_per_pixel,
               rules.unnormalised_displacement ? ResolutionRule::contest : ResolutionRule::paper) {
  if (!rules.limit_search_radius) radius_ = std::numeric_limits<double>::infinity();
}

bool Exposure::in_fov(const Vector3d& p_C) const {
  return p_C.x() > 0.0 && std::abs(p_C.y()) <= tan_half_hfov_ * p_C.x() &&
         std::abs(p_C.z()) <= tan_half_vfov_ * p_C.x();
}

std::optional<Vector3d> Exposure::view(const Vector3d& p_W) const {
  if ((p_W - p_WC_).squaredNorm() >= radius_ * radius_) return std::nullopt;
  const Vector3d p_C = to_camera(p_W);
  if (!in_fov(p_C)) return std::nullopt;
  return p_C;
}

Exposure::PixelPair Exposure::pixel_move(const Vector3d& p_C) const {
  // The point is moved along a straight line. It may end up behind the camera; the reference does not check this.
  const Vector3d moved = p_C - exposure_s_ * (w_C_.cross(p_C) + v_C_);
  return {pixels_per_slope_ * std::abs(p_C.z() / p_C.x() - moved.z() / moved.x()),
          pixels_per_slope_ * std::abs(p_C.y() / p_C.x() - moved.y() / moved.x())};
}

std::optional<Exposure::PixelPair> Exposure::mm_per_pixel(const Vector3d& p_C, const Vector3d& n_W) const {
  const Vector3d n = (R_CW_ * n_W).normalized();
  Vector3d dx(-n.z(), 0.0, n.x()), dy(-n.y(), n.x(), 0.0);
  if (rule_ == ResolutionRule::paper) {
    // If a surface is seen exactly edge-on, a step is zero, so that the quality of the resolution becomes 0.
    dx.normalize();
    dy.normalize();
  }
  dx *= kHalfStep;
  dy *= kHalfStep;
  if (p_C.x() < std::max(std::abs(dx.x()), std::abs(dy.x()))) return std::nullopt;

  const double slope_v = (p_C.z() + dx.z()) / (p_C.x() + dx.x()) - (p_C.z() - dx.z()) / (p_C.x() - dx.x());
  const double slope_u = (p_C.y() + dy.y()) / (p_C.x() + dy.x()) - (p_C.y() - dy.y()) / (p_C.x() - dy.x());
  // The step is 1 mm, so mm per pixel is one over the pixels that it spans.
  return PixelPair{1.0 / (pixels_per_slope_ * std::abs(slope_u)), 1.0 / (pixels_per_slope_ * std::abs(slope_v))};
}

double Exposure::blur_quality(const PixelPair& move) const {
  // A point that is moved into the camera's own plane gives 0 / 0: it moves across the whole picture, so its quality is
  // 0. Both values are checked for NaN, because std::max() may return the other value.
  if (std::isnan(move.u) || std::isnan(move.v)) return 0.0;
  const double pixels = std::max(move.u, move.v);
  return pixels <= 1.0 ? 1.0 : 1.0 / pixels;
}

double Exposure::resolution_quality(const PixelPair& mm) const {
  if (std::isnan(mm.u) || std::isnan(mm.v)) return 0.0;
  return std::min(1.0, desired_mm_per_pixel_ / std::max(mm.u, mm.v));
}

std::optional<PointScore> Exposure::score(const Vector3d& p_C, const Vector3d& n_W) const {
  if (!(p_C.x() > 0.0)) return std::nullopt;
  const auto mm = mm_per_pixel(p_C, n_W);
  if (!mm) return std::nullopt;
  return PointScore{blur_quality(pixel_move(p_C)), resolution_quality(*mm), distance_quality(p_C.x())};
}

PointQuality Exposure::evaluate(const Vector3d& p_W, const Vector3d& n_W) const {
  PointQuality quality;
  quality.p_C = to_camera(p_W);
  quality.in_search_radius = (p_W - p_WC_).squaredNorm() < radius_ * radius_;
  quality.in_fov = in_fov(quality.p_C);
  if (!quality.in_fov) return quality;

  const PixelPair move = pixel_move(quality.p_C);
  quality.pixel_move_u = move.u;
  quality.pixel_move_v = move.v;
  quality.q_blur = blur_quality(move);
  if (const auto mm = mm_per_pixel(quality.p_C, n_W)) {
    quality.mm_per_pixel_u = mm->u;
    quality.mm_per_pixel_v = mm->v;
    quality.q_res = resolution_quality(*mm);
    quality.score = quality.q_blur * *quality.q_res;
  }
  return quality;
}

}  // namespace skein
