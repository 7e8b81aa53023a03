#include "uav_agent/maps/world_mapper.hpp"

#include <gtest/gtest.h>

#include "core/lidar_geometry.hpp"

namespace skein::agent {
namespace {

BeamScan scan_of_nothing(const LidarConfig& lidar, Tick tick, double servo_angle) {
  BeamScan scan{.tick = tick, .columns = lidar.columns};
  scan.beams.assign(static_cast<std::size_t>(lidar.rings * lidar.columns), {BeamState::none, 0.0F});
  scan.fired = {{.tick = tick, .X_WL = lidar_pose(Isometry3d(Eigen::Translation3d(0.25, 0.25, 20.25)), servo_angle)}};
  return scan;
}

// Something hangs 0.6 m above a UAV that stands in the open: its LiDAR drops it as it drops the sky.
TEST(WorldMapper, WhatIsTooNearToBeSeenIsNotTakenForSky) {
  const LidarConfig lidar;
  for (const double clear_m : {0.5, 1.2}) {
    WorldMapper::Config config;
    config.start_clear_m = clear_m;
    WorldMapper mapper(lidar, config);
    for (int scan = 0; scan < 80; ++scan) {
      mapper.insert(scan_of_nothing(lidar, 3 * scan * lidar_period(lidar), 0.02 * scan));
    }
    EXPECT_EQ(mapper.map().at({0.25, 3.25, 20.25}) == Space::free, clear_m > 1.0) << clear_m;
  }
}

TEST(WorldMapper, TakesInEachSoManyScansAndNoneOfWhichItDoubts) {
  const LidarConfig lidar;
  WorldMapper::Config config;
  config.every = 3;
  WorldMapper mapper(lidar, config);
  std::uint64_t windows = 0;
  for (int scan = 0; scan < 30; ++scan) {
    BeamScan one = scan_of_nothing(lidar, scan * lidar_period(lidar), 0.05 * scan);
    if (scan == 9) one.doubt = ScanDoubt::misfit;
    mapper.insert(one);
    const std::uint64_t now = mapper.map().counts().windows;
    EXPECT_EQ(now > windows, scan % 3 == 0 && scan != 9) << scan;
    windows = now;
  }
}

}  // namespace
}  // namespace skein::agent
