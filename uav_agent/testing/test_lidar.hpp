// A simulated LiDAR for tests, in a world of solid boxes on level ground (z = 0). It fires all beams at once, without
// noise and lost returns, and does not see other UAVs.
// Frames: W world, B body, L LiDAR (core/vehicle/lidar_geometry.hpp).   Units: SI, radians.   Pure; threads: any.
#pragma once

#include <vector>

#include "core/scenario/scenario.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

class TestLidar {
 public:
  explicit TestLidar(const LidarConfig& config);

  /// Whether a scan falls on this tick.
  bool due(Tick tick) const;
  /// Angle and rate of the servo; its angle was 0 at tick 0.
  LidarServo servo(Tick tick) const;
  /// The points that returned, in the order of the beams, like the simulator's cloud.
  Scan scan(Tick tick, const Isometry3d& X_WB, const std::vector<OrientedBox>& solids) const;

 private:
  LidarConfig config_;
  std::vector<Vector3d> directions_L_;
};

}  // namespace skein::agent
