// A LiDAR in a world of solid boxes on level ground (z = 0), for tests: all its beams at once, no noise, no return
// lost. Other UAVs' bodies are not there for it.
// Frames: W world, B body, L LiDAR (core/vehicle/lidar_geometry.hpp).   Units: SI, radians.   Pure; threads: any.
#pragma once

#include <vector>

#include "core/scenario.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

class TestLidar {
 public:
  explicit TestLidar(const LidarConfig& config);

  /// Whether a scan falls on this tick.
  bool due(Tick tick) const;
  /// Where the servo stands, which was at angle 0 at tick 0.
  LidarServo servo(Tick tick) const;
  /// In the order of the beams, as the simulator's.
  Scan scan(Tick tick, const Isometry3d& X_WB, const std::vector<OrientedBox>& solids) const;

 private:
  LidarConfig config_;
  std::vector<Vector3d> directions_L_;
};

}  // namespace skein::agent
