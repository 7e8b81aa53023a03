#include "uav_agent/planning/aiming.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

/// Unit vector along the camera's optical axis, in a level frame with the body's heading: R_z(yaw) R_y(pitch) e_x.
/// @param pitch, yaw  of the gimbal.
Vector3d optical_axis(double pitch, double yaw) {
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), -std::sin(pitch)};
}

}  // namespace

GimbalCommand aim_at(const Vector3d& p_W, const RigidBodyState& state, const VehicleConfig& vehicle) {
  const Vector3d to_point = p_W - state.X_WB() * vehicle.camera.p_BC;
  const double body_yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw;
  const double pitch_limit = vehicle.gimbal.pitch_limit_deg * kRadPerDeg;
  const double yaw_limit = vehicle.gimbal.yaw_limit_deg * kRadPerDeg;
  const double pitch = std::atan2(-to_point.z(), to_point.head<2>().norm());
  const double yaw = wrap_angle(std::atan2(to_point.y(), to_point.x()) - body_yaw);
  return {GimbalMode::angle, std::clamp(pitch, -pitch_limit, pitch_limit), std::clamp(yaw, -yaw_limit, yaw_limit)};
}

std::optional<double> yaw_facing(const Vector3d& out_W) {
  constexpr double kTopOrBottom = 0.5;  // chosen: a face with |out_W.z()| of at least this is a top or bottom
  return std::abs(out_W.z()) < kTopOrBottom ? std::optional(std::atan2(-out_W.y(), -out_W.x())) : std::nullopt;
}

double aim_error(const Vector3d& p_W, const RigidBodyState& state, const GimbalState& gimbal,
                 const VehicleConfig& vehicle) {
  const GimbalCommand wanted = aim_at(p_W, state, vehicle);
  const double cosine = optical_axis(wanted.pitch, wanted.yaw).dot(optical_axis(gimbal.pitch, gimbal.yaw));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace skein::agent
