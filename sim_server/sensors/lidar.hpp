// Rotating LiDAR of an explorer: a VLP-16 on a servo that swings about body x.
// Frames: W world, B body, S servo (turned about body x, at p_BS), L optical centre of the LiDAR, axes as S.
// Units: SI, radians.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scenario.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/conditions/lidar_errors.hpp"
#include "sim_server/sensors/lost_returns.hpp"

namespace skein::sim {

struct LidarScan {
  Tick tick = 0;
  std::uint64_t number = 0;  ///< 0, 1, ... for this LiDAR
  double servo_angle = 0.0;  ///< [rad]
  Isometry3d X_WL = Isometry3d::Identity();
  std::vector<Eigen::Vector3f> points_W;  ///< ring by ring upwards, in each by azimuth from -pi; no return, no point
};

class Lidar {
 public:
  /// @param uav   fleet index: its own body is invisible to it, and it keys the noise.
  /// @param seed  0: no range noise, no lost returns, and the servo starts at 0. Otherwise the servo's phase and the
  ///              noise are drawn from streams keyed by (seed, "lidar_phase", uav) and (seed, "lidar_noise", uav, scan
  ///              number). A beam whose return is lost draws its noise, too: that of the others does not change.
  /// @param conditions  what it measures worse than its vehicle's file says; drawn with seed 0, too.
  Lidar(const LidarConfig& config, UavIndex uav, std::uint64_t seed, const LidarConditions& conditions = {});

  /// @param conditions  for the scans that follow.
  void change_conditions(const LidarConditions& conditions) { errors_.change(conditions); }

  /// Whether a scan falls on this tick: tick 0 and every period after it.
  bool due(Tick tick) const { return tick % period_ == 0; }

  /// Where the servo stands at a tick >= 0.
  LidarServo servo(Tick tick) const;

  /// Tells where the body was at a tick, before scan() of that tick. Needed with `motion_distortion` only, at every
  /// tick; without it this does nothing.
  void move(Tick tick, const Isometry3d& X_WB);

  /// One whole scan. Its number counts periods, whether they were scanned or not.
  ///
  /// Usually of one instant. With `motion_distortion` it took the period up to this tick: column c of n was fired when
  /// c / n of the period had passed, from where body and servo were then, to the tick. Its points are placed from
  /// X_WL of the end, as a driver does that knows nothing of the motion: they are not corrected for it. The other UAVs
  /// stand where they are at the end.
  /// @param world  with the poses of all UAVs at this tick.
  LidarScan scan(Tick tick, const Isometry3d& X_WB, const RayScene& world);
  /// What the beams of the last scan met, without noise, however near, and whether or not their
  /// returns were lost; ring by ring; infinite: nothing.
  std::span<const double> ranges() const { return ranges_; }

 private:
  Isometry3d pose(Tick tick, const Isometry3d& X_WB) const;
  void trace(const Isometry3d& X_WL, int first_column, int columns, const RayScene& world);

  LidarConfig config_;
  UavIndex uav_;
  std::uint64_t seed_;
  Tick period_;
  LostReturns lost_;
  LidarErrors errors_;
  Tick phase_ = 0;                 ///< how long the servo has been running at tick 0
  Eigen::Matrix3Xf directions_L_;  ///< of all beams, in the order of the cloud
  std::vector<Isometry3d> past_;   ///< X_WB by tick modulo the period
  std::vector<Eigen::Vector3f> directions_W_;
  std::vector<double> distances_;  ///< of the columns traced last
  std::vector<double> ranges_;     ///< of all beams
};

}  // namespace skein::sim
