// Roll, pitch and yaw of an attitude; wrapping of angles; rotations about z and y.
// Convention: R_WB = Rz(yaw) Ry(pitch) Rx(roll).   Units: radians.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/types.hpp"

namespace skein {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

struct RollPitchYaw {
  double roll = 0.0, pitch = 0.0, yaw = 0.0;
};

/// Euler angles of a rotation; yaw in (-pi, pi], pitch in [-pi/2, pi/2]. Pure.
inline RollPitchYaw roll_pitch_yaw(const Matrix3d& R_WB) {
  return {std::atan2(R_WB(2, 1), R_WB(2, 2)), std::asin(std::clamp(-R_WB(2, 0), -1.0, 1.0)),
          std::atan2(R_WB(1, 0), R_WB(0, 0))};
}

/// Wraps an angle into [-pi, pi), up to rounding errors. Pure.
inline double wrap_angle(double angle) {
  const double turn = 2.0 * std::numbers::pi;
  const double from_behind = std::fmod(angle + std::numbers::pi, turn);
  return (from_behind < 0.0 ? from_behind + turn : from_behind) - std::numbers::pi;
}

/// Rotation matrices about the z axis and about the y axis. Pure.
inline Matrix3d rotation_z(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }
inline Matrix3d rotation_y(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix(); }

}  // namespace skein
