// The LiDAR in rooms whose walls are known, and the motion of its servo.
#include "sim_server/sensors/lidar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numbers>
#include <set>

#include "core/math/euler.hpp"
#include "core/vehicle/lidar_geometry.hpp"
#include "sim_server/sensors/key_frames.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kDeg = kRadPerDeg;

TEST(ServoAngle, TheServoAngleIsThatOfTheReference) {
  const LidarConfig config;
  struct Case {
    double t_s, angle_deg;
  };
  // The servo reaches its stop after two seconds, and waits there until it reverses at 4 s; then a triangle wave.
  for (const auto& [t_s, angle_deg] : {Case{0.0, 0.0},
                                       {1.0, 45.0},
                                       {2.0, 90.0},
                                       {3.0, 90.0},
                                       {3.999, 90.0},
                                       {4.0, 90.0},
                                       {5.0, 45.0},
                                       {6.0, 0.0},
                                       {7.5, -67.5},
                                       {8.0, -90.0},
                                       {9.0, -45.0},
                                       {12.0, 90.0},
                                       {14.0, 0.0},
                                       {16.0, -90.0},
                                       {4801.0, -45.0}}) {
    EXPECT_NEAR(servo_angle(config, t_s), angle_deg * kDeg, 1e-9) << t_s;
  }
}

/// Compares the closed form with a servo that moves tick by tick. The servo reaches both stops, one, or none.
TEST(ServoAngle, TheServoAngleIsThatOfAServoThatMovesTickByTick) {
  for (const double limit_deg : {30.0, 60.0, 90.0, 120.0, 200.0}) {
    for (const double rate_deg_s : {10.0, 30.0, 45.0}) {
      LidarConfig config;
      config.servo_limit_deg = limit_deg;
      config.servo_rate_deg_s = rate_deg_s;
      double angle = 0.0;
      for (Tick tick = 0; tick < 40 * kTicksPerSecond; ++tick) {
        ASSERT_NEAR(servo_angle(config, seconds(tick)), angle, 1e-9) << limit_deg << " " << rate_deg_s << " " << tick;
        const bool upwards = tick / (4 * kTicksPerSecond) % 2 == 0;
        angle = std::clamp(angle + (upwards ? 1.0 : -1.0) * rate_deg_s * kDeg * kTickS, -limit_deg * kDeg,
                           limit_deg * kDeg);
      }
    }
  }
}

/// servo_rate() is the slope of servo_angle() just after a time.
TEST(ServoAngle, TheServoAngleChangesAtTheStatedRate) {
  for (const double limit_deg : {30.0, 60.0, 90.0, 120.0}) {
    LidarConfig config;
    config.servo_limit_deg = limit_deg;
    std::set<double> rates;
    for (Tick tick = 0; tick < 20 * kTicksPerSecond; ++tick) {
      const double t = seconds(tick), onwards = servo_angle(config, t + 1e-6) - servo_angle(config, t);
      const double rate = servo_rate(config, t);
      ASSERT_NEAR(onwards, 1e-6 * rate, 1e-12) << limit_deg << " " << tick;
      rates.insert(rate);
    }
    EXPECT_EQ(rates.size(), 3U) << "up, down, and at a stop";
  }
}

TEST(Lidar, AScanIsDueTenTimesASecond) {
  const Lidar lidar(LidarConfig{}, UavIndex{0}, 0);
  int scans = 0;
  for (Tick tick = 0; tick < 10 * kTicksPerSecond; ++tick) {
    scans += lidar.due(tick);
  }
  EXPECT_EQ(scans, 100);
  EXPECT_TRUE(lidar.due(0));
}

class LidarRoom : public ::testing::Test {
 protected:
  static RayScene room() {
    TriangleMesh mesh;
    test::add_box(mesh, kCentre, kSize);
    return RayScene(mesh, {body_shape(VehicleConfig{}), body_shape(VehicleConfig{})});
  }
  /// Distance from a point inside to the room's wall along a unit vector.
  static double wall_distance(const Vector3d& p, const Vector3d& direction) {
    double nearest = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double wall = kCentre[axis] + std::copysign(0.5 * kSize[axis], direction[axis]);
      nearest = std::min(nearest, (wall - p[axis]) / direction[axis]);
    }
    return nearest;
  }
  static inline const Vector3d kCentre{10.0, -5.0, 20.0};
  static inline const Vector3d kSize{30.0, 24.0, 18.0};
  const Isometry3d X_WB_ = Eigen::Translation3d(7.0, -4.0, 18.0) * Eigen::Quaterniond(test::rotation(0.1, -0.15, 2.2));
};

TEST_F(LidarRoom, AllBeamsMeetTheWalls) {
  const RayScene world = room();
  Lidar lidar(LidarConfig{}, UavIndex{0}, 0);
  for (const Tick tick : {0, 1000, 2200, 4040}) {
    const LidarScan scan = lidar.scan(tick, X_WB_, world);
    // Order of the cloud: rings from -15 to 15 degrees, two degrees apart; in each ring, columns from azimuth -pi on.
    ASSERT_EQ(scan.points_W.size(), 16U * 440U);
    const Isometry3d X_WL = X_WB_ * Eigen::Translation3d(0.0, 0.0, 0.2) *
                            Eigen::AngleAxisd(servo_angle(LidarConfig{}, seconds(tick)), Vector3d::UnitX()) *
                            Eigen::Translation3d(0.0, 0.0, 0.00185);
    ASSERT_TRUE(X_WL.isApprox(scan.X_WL, 1e-12));
    for (int ring = 0; ring < 16; ++ring) {
      for (int column = 0; column < 440; ++column) {
        const double elevation = (-15.0 + 2.0 * ring) * kDeg, azimuth = (-180.0 + 360.0 * column / 440.0) * kDeg;
        const Vector3d direction =
            X_WL.linear() * Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                     std::sin(elevation));
        const Vector3d expected = X_WL.translation() + wall_distance(X_WL.translation(), direction) * direction;
        ASSERT_LT((scan.points_W[ring * 440 + column].cast<double>() - expected).norm(), 1e-4);
      }
    }
  }
}

/// Pose at a tick of a body that turns and drifts, and is at X_WB at tick 80.
Isometry3d moving_body(const Isometry3d& X_WB, Tick tick) {
  const double t = seconds(tick - 80);
  return Eigen::Translation3d(2.0 * t, -1.0 * t, 0.5 * t) * X_WB *
         Eigen::AngleAxisd(1.2 * t, Vector3d(0.2, -0.1, 1.0).normalized());
}

TEST_F(LidarRoom, MotionDistortionDoesNotChangeTheScanOfABodyAtRest) {
  const RayScene world = room();
  LidarConfig config;
  config.servo_rate_deg_s = 0.0;
  Lidar instant(config, UavIndex{0}, 7);
  config.motion_distortion = true;
  Lidar sweeping(config, UavIndex{0}, 7);
  for (Tick tick = 0; tick <= 80; ++tick) sweeping.move(tick, X_WB_);
  EXPECT_EQ(sweeping.scan(80, X_WB_, world).points_W, instant.scan(80, X_WB_, world).points_W);
}

TEST_F(LidarRoom, MotionDuringAScanDistortsThePointsAsGeometryRequires) {
  const RayScene world = room();
  LidarConfig config;
  config.motion_distortion = true;
  Lidar lidar(config, UavIndex{0}, 0);
  for (Tick tick = 0; tick <= 80; ++tick) lidar.move(tick, moving_body(X_WB_, tick));
  const LidarScan scan = lidar.scan(80, moving_body(X_WB_, 80), world);
  ASSERT_EQ(scan.points_W.size(), 16U * 440U);
  double farthest = 0.0;
  for (int ring = 0; ring < 16; ++ring) {
    for (int column = 0; column < 440; ++column) {
      const Tick fired = 41 + column / 11;  // 40 ticks of 11 columns
      const Isometry3d X_WL = moving_body(X_WB_, fired) * Eigen::Translation3d(0.0, 0.0, 0.2) *
                              Eigen::AngleAxisd(servo_angle(config, seconds(fired)), Vector3d::UnitX()) *
                              Eigen::Translation3d(0.0, 0.0, 0.00185);
      const double elevation = (-15.0 + 2.0 * ring) * kDeg, azimuth = (-180.0 + 360.0 * column / 440.0) * kDeg;
      const Vector3d beam(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation));
      const Vector3d direction = X_WL.linear() * beam;
      const double range = wall_distance(X_WL.translation(), direction);
      const Vector3d point = scan.points_W[static_cast<std::size_t>(ring * 440 + column)].cast<double>();
      ASSERT_LT((point - scan.X_WL * Vector3d(range * beam)).norm(), 1e-4) << ring << ' ' << column;
      farthest = std::max(farthest, (point - X_WL.translation() - range * direction).norm());
    }
  }
  EXPECT_GT(farthest, 0.5) << "the oldest beams are a tenth of a second old";
}

TEST_F(LidarRoom, ScanNumbersCountPeriods) {
  const RayScene world = room();
  Lidar lidar(LidarConfig{}, UavIndex{0}, 0);
  EXPECT_EQ(lidar.scan(0, X_WB_, world).number, 0U);
  const LidarScan third = lidar.scan(80, X_WB_, world);
  EXPECT_EQ(third.number, 2U);
  EXPECT_EQ(third.tick, 80);
}

TEST_F(LidarRoom, RangeLimitsLeavePointsOut) {
  const RayScene world = room();
  LidarConfig config;
  config.range_min_m = 12.0;
  config.range_max_m = 14.0;
  Lidar limited(config, UavIndex{0}, 0), whole(LidarConfig{}, UavIndex{0}, 0);
  const LidarScan scan = limited.scan(0, X_WB_, world);
  const LidarScan all = whole.scan(0, X_WB_, world);
  std::vector<Eigen::Vector3f> expected;
  std::ranges::copy_if(all.points_W, std::back_inserter(expected), [&all](const Eigen::Vector3f& p) {
    const double range = (p.cast<double>() - all.X_WL.translation()).norm();
    return range >= 12.0 && range <= 14.0;
  });
  EXPECT_GT(expected.size(), 100U);
  EXPECT_EQ(scan.points_W, expected);
}

TEST_F(LidarRoom, TheLidarSeesOtherUavsButNotItsOwnBody) {
  RayScene world = room();
  Lidar alone(LidarConfig{}, UavIndex{0}, 0), lidar(LidarConfig{}, UavIndex{0}, 0);
  const auto without = alone.scan(0, X_WB_, world);
  world.set_pose(UavIndex{0}, X_WB_);
  EXPECT_EQ(lidar.scan(0, X_WB_, world).points_W, without.points_W);
  const Vector3d other = X_WB_ * Vector3d(4.0, 0.0, 0.2);
  world.set_pose(UavIndex{1}, Isometry3d(Eigen::Translation3d(other)));
  const auto with = lidar.scan(0, X_WB_, world).points_W;
  EXPECT_EQ(with.size(), without.points_W.size());
  EXPECT_GT(std::ranges::count_if(
                with, [&other](const Eigen::Vector3f& p) { return (p.cast<double>() - other).norm() < 0.7; }),
            5);
}

/// Noise acts along the beam, has the configured size, and depends only on seed, UAV and scan.
TEST_F(LidarRoom, NoiseDependsOnSeedUavAndScan) {
  const RayScene world = room();
  LidarConfig config;
  config.servo_rate_deg_s = 0.0;  // so that the phase does not matter
  Lidar clean(config, UavIndex{0}, 0), noisy(config, UavIndex{0}, 5), again(config, UavIndex{0}, 5),
      other_seed(config, UavIndex{0}, 6), other_uav(config, UavIndex{1}, 5);
  const LidarScan reference = clean.scan(0, X_WB_, world), scan = noisy.scan(0, X_WB_, world);
  EXPECT_EQ(scan.points_W, again.scan(0, X_WB_, world).points_W);
  EXPECT_NE(scan.points_W, other_seed.scan(0, X_WB_, world).points_W);
  EXPECT_NE(scan.points_W, other_uav.scan(0, X_WB_, world).points_W);
  EXPECT_NE(scan.points_W, noisy.scan(40, X_WB_, world).points_W);
  ASSERT_EQ(scan.points_W.size(), reference.points_W.size());
  double sum = 0.0, sum2 = 0.0;
  for (std::size_t i = 0; i < scan.points_W.size(); ++i) {
    const Vector3d beam = (reference.points_W[i].cast<double>() - reference.X_WL.translation()).normalized();
    const Vector3d error = (scan.points_W[i] - reference.points_W[i]).cast<double>();
    EXPECT_LT(error.cross(beam).norm(), 1e-5);
    sum += error.dot(beam);
    sum2 += error.squaredNorm();
  }
  const auto n = static_cast<double>(scan.points_W.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 * 0.01 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(sum2 / n), 0.01, 0.0005);
}

/// A scan has no points for lost returns. Nothing else changes: neither the noise of other points nor the true ranges.
TEST_F(LidarRoom, LostReturnsAreNoPointsAndTheOthersStayTheSame) {
  const RayScene world = room();
  LidarConfig config;
  for (const bool distorted : {false, true}) {
    config.motion_distortion = distorted;
    LidarConfig losing = config;
    losing.no_return_p = 0.3;
    losing.dropped_sectors = {.share = 0.2, .width_deg = 30.0, .hold_s = 0.3};
    Lidar whole(config, UavIndex{0}, 5), lidar(losing, UavIndex{0}, 5);
    LostReturns lost(losing, UavIndex{0}, 5);
    for (const Tick tick : {0, 40, 80, 400, 4000}) {
      const LidarScan scan = lidar.scan(tick, X_WB_, world), all = whole.scan(tick, X_WB_, world);
      ASSERT_EQ(all.points_W.size(), 16U * 440U);
      std::vector<Eigen::Vector3f> expected;
      const std::vector<bool>& missing = lost.of(tick);
      for (std::size_t i = 0; i < missing.size(); ++i) {
        if (!missing[i]) expected.push_back(all.points_W[i]);
      }
      EXPECT_LT(expected.size(), 6000U);
      EXPECT_GT(expected.size(), 1000U);
      EXPECT_EQ(scan.points_W, expected);
      EXPECT_TRUE(std::ranges::equal(lidar.ranges(), whole.ranges()));
      const auto key_frame = KeyFrameSelector().offer(scan, X_WB_);
      ASSERT_TRUE(key_frame);
      EXPECT_EQ(key_frame->points_W, sample_uniformly(expected, KeyFrameSelector::kCell));
    }
  }
}

TEST_F(LidarRoom, NoReturnIsLostWithSeedZeroOrWithAShareOfZero) {
  const RayScene world = room();
  LidarConfig losing, nothing;
  losing.no_return_p = 0.5;
  losing.dropped_sectors = {.share = 0.5, .width_deg = 30.0, .hold_s = 1.0};
  nothing.dropped_sectors = {.share = 0.0, .width_deg = 30.0, .hold_s = 1.0};
  for (const auto& [config, seed] : {std::pair{losing, std::uint64_t{0}}, {nothing, std::uint64_t{5}}}) {
    const LidarScan scan = Lidar(config, UavIndex{0}, seed).scan(40, X_WB_, world);
    EXPECT_EQ(scan.points_W, Lidar(LidarConfig{}, UavIndex{0}, seed).scan(40, X_WB_, world).points_W);
  }
}

/// The walls of the narrow room are partly nearer than 0.9 m, those of the wide room partly farther than 50 m.
TEST(Lidar, TheLidarSeesFromNinetyCentimetresToFiftyMetres) {
  const auto farthest_and_nearest = [](double half_size) {
    TriangleMesh mesh;
    test::add_box(mesh, {0.0, 0.0, 200.0 + 0.2 + 0.00185}, Vector3d::Constant(2.0 * half_size));
    const RayScene world(mesh);
    const LidarScan scan =
        Lidar(LidarConfig{}, UavIndex{0}, 0).scan(0, Isometry3d(Eigen::Translation3d(0.0, 0.0, 200.0)), world);
    std::pair ranges{0.0, 1e9};
    for (const Eigen::Vector3f& p : scan.points_W) {
      const double range = (p.cast<double>() - scan.X_WL.translation()).norm();
      ranges = {std::max(ranges.first, range), std::min(ranges.second, range)};
    }
    return ranges;
  };
  const auto [far_in_narrow, near_in_narrow] = farthest_and_nearest(0.8);
  EXPECT_GE(near_in_narrow, 0.9 - 1e-4);
  EXPECT_LT(near_in_narrow, 0.92);
  EXPECT_GT(far_in_narrow, 1.1);
  const auto [far_in_wide, near_in_wide] = farthest_and_nearest(48.0);
  EXPECT_LE(far_in_wide, 50.0 + 1e-3);
  EXPECT_GT(far_in_wide, 49.5);
  EXPECT_NEAR(near_in_wide, 48.0, 0.05);
}

TEST_F(LidarRoom, TheNoiseHasTheConfiguredDeviation) {
  const RayScene world = room();
  LidarConfig config;
  config.servo_rate_deg_s = 0.0;
  const LidarScan clean = Lidar(config, UavIndex{0}, 0).scan(0, X_WB_, world);
  for (const double sigma : {0.0, 0.003, 0.05}) {
    config.sigma_m = sigma;
    const LidarScan scan = Lidar(config, UavIndex{0}, 5).scan(0, X_WB_, world);
    ASSERT_EQ(scan.points_W.size(), clean.points_W.size());
    double sum2 = 0.0;
    for (std::size_t i = 0; i < scan.points_W.size(); ++i) {
      sum2 += (scan.points_W[i] - clean.points_W[i]).cast<double>().squaredNorm();
    }
    EXPECT_NEAR(std::sqrt(sum2 / static_cast<double>(scan.points_W.size())), sigma, 0.03 * sigma + 1e-6);
  }
}

TEST(Lidar, TheSeedDrawsThePhaseOfTheServoOnce) {
  const RayScene world(TriangleMesh{});
  const auto angle_at_start = [&world](UavIndex uav, std::uint64_t seed) {
    return Lidar(LidarConfig{}, uav, seed).scan(0, Isometry3d::Identity(), world).servo_angle;
  };
  EXPECT_EQ(angle_at_start(UavIndex{0}, 0), 0.0);
  EXPECT_EQ(angle_at_start(UavIndex{0}, 3), angle_at_start(UavIndex{0}, 3));
  EXPECT_NE(angle_at_start(UavIndex{0}, 3), angle_at_start(UavIndex{1}, 3));
  EXPECT_NE(angle_at_start(UavIndex{0}, 3), angle_at_start(UavIndex{0}, 4));
}

/// Prints the CPU time of a scan during a flight around the structure, but sets no limit for it.
TEST(Lidar, AScanOfMbsHasPoints) {
  const auto mesh = test::official_mesh("mbs/mbs.stl");
  if (!mesh) {
    GTEST_SKIP() << "SKEIN_ASSETS is not set";
  }
  const RayScene world(*mesh);
  Lidar lidar(LidarConfig{}, UavIndex{0}, 0);
  constexpr int kScans = 200;
  std::size_t points = 0;
  const std::clock_t start = std::clock();
  for (int i = 0; i < kScans; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kScans;
    const Isometry3d X_WB(Eigen::Translation3d(30.0 + 75.0 * std::cos(turn), 40.0 * std::sin(turn), 5.0 + 0.2 * i));
    points += lidar.scan(40 * i, X_WB, world).points_W.size();
  }
  const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / kScans;
  std::cout << "[ measured ] " << ms << " ms of CPU a scan, " << points / kScans << " points\n";
  RecordProperty("ms_per_scan", std::to_string(ms));
  EXPECT_GT(points, 0U);
}

}  // namespace
}  // namespace skein::sim
