#include "uav_agent/maps/scan_beams.hpp"

#include <gtest/gtest.h>

#include "core/lidar_geometry.hpp"

namespace skein::agent {
namespace {

class ScanBeams : public testing::Test {
 protected:
  ScanBeams() {
    lidar_.rings = 2;
    lidar_.columns = 4;
    scan_.columns = 4;
    scan_.beams = {{BeamState::none, 0.0F},  {BeamState::range, 7.0F}, {}, {BeamState::uav, 3.0F},
                   {BeamState::range, 2.0F}, {BeamState::none, 0.0F},  {}, {BeamState::none, 0.0F}};
    const Isometry3d first(Eigen::Translation3d(10.0, 0.0, 20.0)), second(Eigen::Translation3d(10.5, 0.0, 20.0));
    scan_.fired = {{0, 1, first}, {2, 2, second}};
  }
  LidarConfig lidar_;
  BeamScan scan_;
};

TEST_F(ScanBeams, AreThoseOfWhichSomethingIsKnown) {
  const std::vector<Beam> beams = map_beams(scan_, lidar_, [](const auto&, const auto&) { return true; });
  const float most = 50.0F;
  struct Expected {
    int ring, column;
    float free_m;
    bool returned;
  };
  const Expected expected[] = {{0, 0, most, false}, {0, 1, 7.0F, true},  {0, 3, 3.0F, false},
                               {1, 0, 2.0F, true},  {1, 1, most, false}, {1, 3, most, false}};
  ASSERT_EQ(beams.size(), std::size(expected));
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const auto& [ring, column, free_m, returned] = expected[i];
    EXPECT_EQ(beams[i].from_W, Vector3d(column < 2 ? 10.0 : 10.5, 0.0, 20.0)) << i;
    EXPECT_LT((beams[i].direction_W.cast<double>() - lidar_direction_L(lidar_, ring, column)).norm(), 1e-6) << i;
    EXPECT_EQ(beams[i].free_m, free_m) << i;
    EXPECT_EQ(beams[i].returned, returned) << i;
  }
}

TEST_F(ScanBeams, WithoutReturnCountOnlyWhereTheirFirstStretchIsKnownToBeFree) {
  const auto below = [](const Vector3d& a_W, const Vector3d& b_W) {
    EXPECT_NEAR((b_W - a_W).norm(), 0.9, 1e-12);
    return b_W.z() < a_W.z();  // the lower ring alone
  };
  const std::vector<Beam> beams = map_beams(scan_, lidar_, below);
  ASSERT_EQ(beams.size(), 4U);
  EXPECT_EQ(beams[0].free_m, 50.0F);
  EXPECT_TRUE(beams[1].returned);
  EXPECT_EQ(beams[3].free_m, 2.0F) << "what returned proves its own";
}

// Something hangs 0.6 m above a UAV that stands in the open: its LiDAR drops it as it drops the sky.
TEST_F(ScanBeams, WhatIsTooNearToBeSeenIsNotTakenForSky) {
  LidarConfig lidar;
  BeamScan scan{.columns = lidar.columns};
  scan.beams.assign(static_cast<std::size_t>(lidar.rings * lidar.columns), {BeamState::none, 0.0F});
  scan.fired = {{0, 0, lidar_pose(Isometry3d(Eigen::Translation3d(0.25, 0.25, 20.25)), 0.0)}};
  WorldMap map({});
  const auto near_free = [&](const Vector3d& a_W, const Vector3d& b_W) { return map.tube_free(a_W, b_W, 0.0); };
  EXPECT_TRUE(map_beams(scan, lidar, near_free).empty()) << "nothing is known yet";
  map.set_free({0.25, 0.25, 20.25}, 2.0);
  EXPECT_EQ(map_beams(scan, lidar, near_free).size(), scan.beams.size()) << "the place of its start is clear";
}

TEST_F(ScanBeams, AScanInDoubtHasNone) {
  scan_.doubt = ScanDoubt::misfit;
  EXPECT_TRUE(map_beams(scan_, lidar_, [](const auto&, const auto&) { return true; }).empty());
}

}  // namespace
}  // namespace skein::agent
