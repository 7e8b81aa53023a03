#include "uav_agent/maps/world_mapper.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {
namespace {

BeamScan scan_of_nothing(const LidarConfig& lidar, Tick tick, double servo_angle) {
  BeamScan scan{.tick = tick, .columns = lidar.columns};
  scan.beams.assign(static_cast<std::size_t>(lidar.rings * lidar.columns), {BeamState::none, 0.0F});
  scan.fired = {{.tick = tick, .X_WL = lidar_pose(Isometry3d(Eigen::Translation3d(0.25, 0.25, 20.25)), servo_angle)}};
  return scan;
}

// Something hangs 0.6 m above a UAV that stands in the open. It is too near for the LiDAR, which reports no return from
// it, as from the sky.
TEST(WorldMapper, AnObstacleTooNearForTheLidarIsNotTakenForSky) {
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

/// A scan of a LiDAR in front of the wall x = 6. Every second beam returns nothing: if these beams counted, they would
/// satisfy the criterion for the space behind the wall many times over.
BeamScan scan_of_wall(const LidarConfig& lidar, Tick tick, RandomStream& random) {
  const Isometry3d X_WB =
      Eigen::Translation3d(0.25, 0.25, 20.25) * Eigen::AngleAxisd(random.uniform(-3.14, 3.14), Vector3d::UnitZ());
  BeamScan scan{.tick = tick, .columns = lidar.columns};
  scan.fired = {{.tick = tick, .X_WL = lidar_pose(X_WB, random.uniform(-1.57, 1.57))}};
  const Isometry3d& X_WL = scan.fired.front().X_WL;
  for (int ring = 0; ring < lidar.rings; ++ring) {
    for (int column = 0; column < lidar.columns; ++column) {
      const double along = (X_WL.linear() * lidar_direction_L(lidar, ring, column)).x();
      const double range = along > 0.0 ? (6.0 - X_WL.translation().x()) / along : 1e9;
      const bool returns = random.uniform() >= 0.5 && range <= lidar.range_max_m;
      scan.beams.push_back({returns ? BeamState::range : BeamState::none, returns ? static_cast<float>(range) : 0.0F});
    }
  }
  return scan;
}

TEST(WorldMapper, BeamsThatAreLostOnAWallProveNothingBehindIt) {
  LidarConfig whole, losing;
  whole.range_max_m = losing.range_max_m = 12.0;
  losing.no_return_p = 0.5;
  WorldMapper::Config config;
  config.map.to_m = {12.0};
  config.every = 1;
  config.bundle_rad = 0.0;
  for (const LidarConfig& lidar : {losing, whole}) {
    WorldMapper mapper(lidar, config);
    RandomStream random(1, "wall", 0);
    for (int scan = 0; scan < 300; ++scan) mapper.insert(scan_of_wall(lidar, scan * lidar_period(lidar), random));
    std::size_t before = 0, behind = 0;
    for (double y = -2.75; y < 3.0; y += 0.5) {
      for (double z = 17.25; z < 23.0; z += 0.5) {
        before += mapper.map().at({4.25, y, z}) == Space::free;
        behind += mapper.map().at({7.25, y, z}) == Space::free;
      }
    }
    EXPECT_EQ(before, 144U);
    EXPECT_EQ(behind > 0, lidar.no_return_p == 0.0) << "the mapper believes each beam of a LiDAR that loses no returns";
  }
}

TEST(WorldMapper, UsesEveryThirdScanAndNoneInDoubt) {
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
