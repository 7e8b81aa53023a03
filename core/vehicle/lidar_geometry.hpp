// Geometry of an explorer's LiDAR: directions of its beams, its mounting, and the motion of its servo. Both the
// simulator and the on-board software use it.
// Frames: W world, B body, S servo (turned about body x, at p_BS), L optical centre of the LiDAR, axes as S.
// Units: SI, radians.   Pure; safe from any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/scenario/scenario.hpp"

namespace skein {

/// Position of the servo in B [m], and height of the optical centre above the servo's axis [m]: the sensor's base is
/// 0.03585 below the axis, and the optical centre 0.0377 above the base.
inline const Vector3d kLidarServo_p_BS{0.0, 0.0, 0.2};
inline constexpr double kLidarCentreAboveServo = -0.03585 + 0.0377;

/// X_WL of a LiDAR at a servo angle [rad].
inline Isometry3d lidar_pose(const Isometry3d& X_WB, double servo_angle) {
  const Eigen::AngleAxisd R_BS(servo_angle, Vector3d::UnitX());
  return X_WB * Eigen::Translation3d(kLidarServo_p_BS) * R_BS * Eigen::Translation3d(0.0, 0.0, kLidarCentreAboveServo);
}

/// Angle of the servo [rad]. It starts at angle 0, turns at +rate for half a period, then at -rate, and so on; when
/// it reaches a stop, it stays there until the direction changes. Closed form, so that errors do not accumulate.
/// @param t_s  time since the servo was switched on, >= 0.
inline double servo_angle(const LidarConfig& config, double t_s) {
  const double rate = config.servo_rate_deg_s * kRadPerDeg;
  const double limit = config.servo_limit_deg * kRadPerDeg;
  const double half_s = 0.5 * config.servo_period_s;
  const double cycle_s = t_s - config.servo_period_s * std::floor(t_s / config.servo_period_s);
  // `top`: its angle at the end of each half period of +rate; `bottom`: of each half period of -rate.
  const double top = std::min(rate * half_s, limit);
  const double bottom = std::max(top - rate * half_s, -limit);
  if (cycle_s < half_s) {
    const double start = t_s < config.servo_period_s ? 0.0 : bottom;
    return std::min(start + rate * cycle_s, limit);
  }
  return std::max(top - rate * (cycle_s - half_s), -limit);
}
/// Angular rate of the servo from this time on [rad/s]; 0 at a stop.
inline double servo_rate(const LidarConfig& config, double t_s) {
  const double cycle_s = t_s - config.servo_period_s * std::floor(t_s / config.servo_period_s);
  const bool upwards = cycle_s < 0.5 * config.servo_period_s;
  const double angle = servo_angle(config, t_s), limit = config.servo_limit_deg * kRadPerDeg;
  if (upwards ? angle >= limit : angle <= -limit) return 0.0;
  return (upwards ? 1.0 : -1.0) * config.servo_rate_deg_s * kRadPerDeg;
}

/// Elevation of a ring above the scan plane [rad]: rings are evenly spaced, the lowest first.
inline double ring_elevation(const LidarConfig& config, int ring) {
  const double half_fov = 0.5 * config.vertical_fov_deg * kRadPerDeg;
  return config.rings > 1 ? half_fov * (2.0 * ring / (config.rings - 1) - 1.0) : 0.0;
}

/// Azimuth of a column [rad]: evenly spaced over a full turn, from -pi (backwards).
inline double column_azimuth(const LidarConfig& config, int column) {
  return std::numbers::pi * (2.0 * column / config.columns - 1.0);
}

/// Ticks from one scan to the next.
inline Tick lidar_period(const LidarConfig& config) { return std::max<Tick>(1, ticks(1.0 / config.rate_hz)); }

/// With `motion_distortion`, a scan takes one period and ends at its tick. In tick `part` of the period (0, 1, ...) the
/// LiDAR fires the columns from first_column(part) up to, but not including, first_column(part + 1).
inline int first_column(const LidarConfig& config, Tick part) {
  return static_cast<int>(part * config.columns / lidar_period(config));
}
/// Tick at which the LiDAR fires the columns of a part of a scan. @param scan  the tick at which the scan ends.
inline Tick fired_at(const LidarConfig& config, Tick scan, Tick part) { return scan - lidar_period(config) + 1 + part; }
/// Whether the LiDAR fires all beams of this scan in one tick: without motion_distortion, and in a run's first scan.
inline bool fired_at_once(const LidarConfig& config, Tick scan) {
  return !config.motion_distortion || scan < lidar_period(config);
}

/// Unit vector along a beam, in L.
inline Vector3d lidar_direction_L(const LidarConfig& config, int ring, int column) {
  const double elevation = ring_elevation(config, ring), azimuth = column_azimuth(config, column);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

}  // namespace skein
