// Rotating LiDAR of an explorer: a VLP-16 on a servo that swings about body x.
// Frames: W world, B body, S servo (turned about body x, at p_BS), L optical centre of the LiDAR, axes as S.
// Units: SI, radians.   Threads: one at a time for each Lidar.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/conditions/lidar_errors.hpp"
#include "sim_server/sensors/lost_returns.hpp"

namespace skein::sim {

struct LidarScan {
  Tick tick = 0;
  std::uint64_t number = 0;  ///< 0, 1, ... for this LiDAR
  double servo_angle = 0.0;  ///< [rad]
  Isometry3d X_WL = Isometry3d::Identity();
  std::vector<Eigen::Vector3f> points_W;  ///< ring by ring upwards, then by azimuth from -pi; only beams that return
};

class Lidar {
 public:
  /// @param uav   fleet index: keys the draws. The LiDAR does not see this UAV's own body.
  /// @param seed  0: no range noise, no lost returns, and the servo starts at 0. Otherwise the servo's phase and the
  ///              noise are drawn from streams keyed by (seed, "lidar_phase", uav) and (seed, "lidar_noise", uav, scan
  ///              number). A beam whose return is lost draws noise, too, so that the noise of other beams does not
  ///              depend on it.
  /// @param conditions  errors beyond those in the vehicle's file; drawn with seed 0, too.
  Lidar(const LidarConfig& config, UavIndex uav, std::uint64_t seed, const LidarConditions& conditions = {});

  /// @param conditions  for the scans that follow.
  void change_conditions(const LidarConditions& conditions) { errors_.change(conditions); }

  /// Whether a scan is due at this tick: at tick 0, and then once per period.
  bool due(Tick tick) const { return tick % period_ == 0; }

  /// Angle and rate of the servo at a tick >= 0.
  LidarServo servo(Tick tick) const;

  /// Stores the pose of the body at a tick. With `motion_distortion`, call it at every tick, before that tick's scan();
  /// without it, this does nothing.
  void move(Tick tick, const Isometry3d& X_WB);

  /// One whole scan. Its number counts all periods, including those without a computed scan.
  ///
  /// Usually all beams are of one instant. With `motion_distortion` the scan takes the period up to this tick: column c
  /// of n is fired when c / n of the period has passed, from the poses of body and servo at that tick. All points are
  /// placed with X_WL of the scan's end, as by a driver that does not correct for motion. The other UAVs do not move
  /// during the scan: they are at their poses of the scan's end.
  /// @param world  with the poses of all UAVs at this tick.
  LidarScan scan(Tick tick, const Isometry3d& X_WB, const RayScene& world);
  /// True ranges of the beams of the last scan, ring by ring [m]: without noise and minimum range, and also of beams
  /// whose returns were lost; infinite: the beam hits nothing.
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
  Tick phase_ = 0;                 ///< time for which the servo has been running at tick 0
  Eigen::Matrix3Xf directions_L_;  ///< of all beams, in the order of the cloud
  std::vector<Isometry3d> past_;   ///< X_WB by tick modulo the period
  std::vector<Eigen::Vector3f> directions_W_;
  std::vector<double> distances_;  ///< of the columns traced last
  std::vector<double> ranges_;     ///< of all beams
};

}  // namespace skein::sim
