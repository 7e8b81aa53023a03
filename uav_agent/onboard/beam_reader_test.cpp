// Clouds made by hand from random ranges, and the beams reconstructed from them. tests/sensing/beams_test.cpp tests the
// same with the production LiDAR.
#include "uav_agent/onboard/beam_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"
#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {
namespace {

class BeamReaderTest : public testing::Test {
 protected:
  BeamReaderTest() {
    state_.p_WB = {30.0, -20.0, 10.0};
    state_.q_WB = Eigen::AngleAxisd(0.7, Vector3d(0.1, 0.2, 1.0).normalized());
  }

  /// Draws a scan at tick 40, in which half of the beams return.
  Scan drawn(const LidarConfig& config, std::uint64_t key) {
    RandomStream random(key, "ranges", 0);
    ranges_.assign(static_cast<std::size_t>(config.rings * config.columns), 0.0);
    Scan scan{.tick = 40};
    const Isometry3d X_WL = lidar_pose(state_.X_WB(), servo_.angle);
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      if (random.uniform() < 0.5) continue;
      ranges_[i] = random.uniform(config.range_min_m, config.range_max_m);
      const int ring = static_cast<int>(i) / config.columns, column = static_cast<int>(i) % config.columns;
      scan.points_W.push_back((X_WL * Vector3d(ranges_[i] * lidar_direction_L(config, ring, column))).cast<float>());
    }
    return scan;
  }
  BeamReader reader(const LidarConfig& config) {
    BeamReader reader(config);
    reader.hear(40, state_);
    reader.hear(servo_);
    return reader;
  }
  void expect_unknown(const BeamScan& scan, ScanDoubt doubt) {
    EXPECT_EQ(scan.doubt, doubt);
    EXPECT_TRUE(scan.fired.empty());
    EXPECT_EQ(scan.points, 0U);
    for (const BeamScan::Beam& beam : scan.beams) ASSERT_EQ(beam.state, BeamState::unknown);
  }

  RigidBodyState state_;
  LidarServo servo_{40, 0.3, 0.78};
  std::vector<double> ranges_;
};

TEST_F(BeamReaderTest, AssignsEachPointToItsBeamAndNoReturnToTheOtherBeams) {
  LidarConfig one_ring, dense, wide;
  one_ring.rings = 1;
  dense.rings = 128;
  dense.columns = 1000;
  wide.vertical_fov_deg = 170.0;
  for (const LidarConfig& config : {LidarConfig{}, one_ring, dense, wide}) {
    const Scan scan = drawn(config, 1);
    const BeamScan beams = reader(config).read(scan, {});
    ASSERT_EQ(beams.doubt, ScanDoubt::none);
    ASSERT_EQ(beams.beams.size(), ranges_.size());
    EXPECT_EQ(beams.points, scan.points_W.size());
    EXPECT_TRUE(beams.firing(config.columns - 1).X_WL.isApprox(lidar_pose(state_.X_WB(), servo_.angle), 1e-15));
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      ASSERT_EQ(beams.beams[i].state, ranges_[i] > 0.0 ? BeamState::range : BeamState::none) << i;
      ASSERT_NEAR(beams.beams[i].range_m, ranges_[i], 1e-4);
    }
  }
}

// Single points or all points of some columns are missing. The reader still assigns the others to their beams, and
// doubts nothing.
TEST_F(BeamReaderTest, LostReturnsAreBeamsWithoutReturn) {
  const LidarConfig config;
  for (const double lost_p : {0.1, 0.3, 0.5, 0.99}) {
    for (const int sector : {0, 37, 220}) {
      const Scan scan = drawn(config, 7);
      RandomStream random(8, "lost", static_cast<std::uint64_t>(sector));
      Scan left{.tick = scan.tick};
      std::size_t point = 0;
      for (std::size_t i = 0; i < ranges_.size(); ++i) {
        if (ranges_[i] == 0.0) continue;
        const bool lost = random.uniform() < lost_p || static_cast<int>(i) % config.columns < sector;
        if (lost) ranges_[i] = 0.0;
        if (!lost) left.points_W.push_back(scan.points_W[point]);
        ++point;
      }
      const BeamScan beams = reader(config).read(left, {});
      ASSERT_EQ(beams.doubt, ScanDoubt::none);
      EXPECT_EQ(beams.points, left.points_W.size());
      for (std::size_t i = 0; i < ranges_.size(); ++i) {
        ASSERT_EQ(beams.beams[i].state, ranges_[i] > 0.0 ? BeamState::range : BeamState::none) << i;
        ASSERT_NEAR(beams.beams[i].range_m, ranges_[i], 1e-4);
      }
    }
  }
}

TEST_F(BeamReaderTest, AnEmptyCloudIsAScanWithoutReturns) {
  const BeamScan beams = reader({}).read({.tick = 40}, {});
  EXPECT_EQ(beams.doubt, ScanDoubt::none);
  EXPECT_EQ(beams.points, 0U);
  for (const BeamScan::Beam& beam : beams.beams) ASSERT_EQ(beam.state, BeamState::none);
}

// The pose may also be off by exactly a column or a ring, so that each point lies on the line of another beam.
TEST_F(BeamReaderTest, WrongOdometryOrServoAnglesLeaveTheWholeScanUnknown) {
  const LidarConfig config;
  const double column = 2.0 * std::numbers::pi / config.columns, ring = 2.0 * kRadPerDeg;
  const RigidBodyState state = state_;
  const LidarServo servo = servo_;
  servo_.angle = 0.0;
  state_.q_WB = Quaterniond::Identity();
  const Scan level = drawn(config, 2);
  for (const double yaw : {column, -column, 5.0 * column, 0.5 * column, 0.002}) {
    state_.q_WB = Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
    BeamReader wrong = reader(config);
    expect_unknown(wrong.read(level, {}), ScanDoubt::misfit);
    EXPECT_EQ(wrong.scans(ScanDoubt::misfit), 1U);
    EXPECT_EQ(wrong.scans(ScanDoubt::none), 0U);
  }
  state_ = state;
  servo_ = servo;
  const Scan scan = drawn(config, 3);
  for (const Vector3d& jump : {Vector3d(0.05, 0.0, 0.0), Vector3d(0.0, 5.0, 0.0), Vector3d(0.0, 0.0, -300.0)}) {
    state_.p_WB = state.p_WB + jump;
    expect_unknown(reader(config).read(scan, {}), ScanDoubt::misfit);
  }
  state_ = state;
  for (const double turn : {ring, -ring, 0.001}) {
    servo_.angle = servo.angle + turn;
    expect_unknown(reader(config).read(scan, {}), ScanDoubt::misfit);
  }
  servo_ = servo;
  EXPECT_EQ(reader(config).read(scan, {}).doubt, ScanDoubt::none);
}

TEST_F(BeamReaderTest, OnePointThatDoesNotFitLeavesTheWholeScanUnknown) {
  const Scan scan = drawn({}, 4);
  const Isometry3d X_WL = lidar_pose(state_.X_WB(), servo_.angle);
  const auto doubt_with = [&](auto&& change) {
    Scan changed = scan;
    change(changed.points_W);
    return reader({}).read(changed, {}).doubt;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(doubt_with([](auto& points) { std::swap(points[7], points[8]); }), ScanDoubt::misfit);
  EXPECT_EQ(doubt_with([](auto& points) { points.push_back(points.back()); }), ScanDoubt::misfit);
  EXPECT_EQ(doubt_with([&](auto& points) { points[7].x() = nan; }), ScanDoubt::misfit);
  EXPECT_EQ(doubt_with([&](auto& points) { points[0] = X_WL.translation().cast<float>(); }), ScanDoubt::misfit);
  EXPECT_EQ(
      doubt_with([&](auto& points) {
        const Vector3d origin = X_WL.translation();
        points.back() =
            (origin + 60.0 * (points.back().template cast<double>() - origin).normalized()).template cast<float>();
      }),
      ScanDoubt::misfit)
      << "beyond its range";
  EXPECT_EQ(doubt_with([](auto& points) { points.erase(points.begin() + 9); }), ScanDoubt::none) << "a return less";
}

TEST_F(BeamReaderTest, WithoutServoOrOdometryNothingIsKnown) {
  const Scan scan = drawn({}, 5);
  BeamReader deaf((LidarConfig()));
  expect_unknown(deaf.read(scan, {}), ScanDoubt::no_servo);
  deaf.hear(servo_);
  expect_unknown(deaf.read(scan, {}), ScanDoubt::no_pose);
  deaf.hear(40, state_);
  EXPECT_EQ(deaf.read(scan, {}).doubt, ScanDoubt::none);
  LidarConfig distorted;
  distorted.motion_distortion = true;
  expect_unknown(reader(distorted).read({.tick = 40}, {}), ScanDoubt::no_servo);
  for (const ScanDoubt doubt : {ScanDoubt::none, ScanDoubt::no_servo, ScanDoubt::no_pose}) {
    EXPECT_EQ(deaf.scans(doubt), 1U);
  }
}

TEST_F(BeamReaderTest, HitsOnOtherUavsAreNoStructureAndBeamsPastThemProveNothing) {
  const LidarConfig config;
  const Scan scan = drawn(config, 6);
  const Isometry3d X_WL = lidar_pose(state_.X_WB(), servo_.angle);
  const KnownBody other{X_WL * Vector3d(12.0, 3.0, 0.5), 3.0};
  const KnownBody far{X_WL * Vector3d(54.0, 0.0, 0.0), 3.0};
  const BeamScan alone = reader(config).read(scan, {}), beams = reader(config).read(scan, std::vector{other, far});
  std::size_t uavs = 0, hidden = 0, beyond = 0;
  for (int ring = 0; ring < config.rings; ++ring) {
    for (int column = 0; column < config.columns; ++column) {
      const Vector3d along = X_WL.linear() * lidar_direction_L(config, ring, column);
      const Vector3d to_other = other.p_W - X_WL.translation();
      const bool passes = to_other.dot(along) > 0.0 && to_other.cross(along).norm() < other.radius_m;
      const BeamScan::Beam &before = alone.beam(ring, column), &beam = beams.beam(ring, column);
      const Vector3d end = X_WL.translation() + before.range_m * along;
      BeamState expected = before.state;
      if (before.state == BeamState::none && passes) expected = BeamState::unknown, ++hidden;
      if (before.state == BeamState::range && (end - other.p_W).norm() < other.radius_m) {
        expected = BeamState::uav, ++uavs;
      } else if (before.state == BeamState::range && passes && before.range_m > 16.0F) {
        ++beyond;
      }
      ASSERT_EQ(beam.state, expected) << ring << ' ' << column;
      ASSERT_EQ(beam.range_m, before.range_m);
    }
  }
  EXPECT_GT(uavs, 1U);
  EXPECT_GT(hidden, 10U);
  EXPECT_GT(beyond, 10U) << "returns from behind the other UAV still count";
}

/// The other UAV is ahead, behind, above, on the axis, across the seam of the columns, near, far, or around the LiDAR
/// itself.
TEST_F(BeamReaderTest, MarksTheBeamsThatMeetAnotherUavWhereverItIs) {
  LidarConfig one_ring, wide, odd;
  one_ring.rings = 1;
  wide.vertical_fov_deg = 170.0;
  odd.columns = 333;
  std::size_t marked = 0;
  for (const LidarConfig& config : {LidarConfig{}, one_ring, wide, odd}) {
    const Scan scan = drawn(config, 7);
    const Isometry3d X_WL = lidar_pose(state_.X_WB(), servo_.angle);
    RandomStream random(8, "bodies", 0);
    for (int draw = 0; draw < 60; ++draw) {
      Vector3d direction_L = Vector3d(random.normal(), random.normal(), 0.3 * random.normal()).normalized();
      if (draw % 6 == 0) direction_L = Vector3d(0.01 * random.normal(), 0.0, random.normal()).normalized();
      if (draw % 6 == 1) direction_L = Vector3d(-1.0, 0.02 * random.normal(), 0.1 * random.normal()).normalized();
      const double radius_m = random.uniform(0.3, 2.0), distance_m = random.uniform(0.1, draw % 3 == 0 ? 4.0 : 51.0);
      const KnownBody body{X_WL * Vector3d(distance_m * direction_L), radius_m};
      const BeamScan alone = reader(config).read(scan, {}), beams = reader(config).read(scan, std::vector{body});
      for (int i = 0; i < config.rings * config.columns; ++i) {
        const Vector3d along = X_WL.linear() * lidar_direction_L(config, i / config.columns, i % config.columns);
        const Vector3d to_body = body.p_W - X_WL.translation();
        const BeamScan::Beam& before = alone.beams[static_cast<std::size_t>(i)];
        const double nearest = std::clamp(to_body.dot(along), 0.0, config.range_max_m);
        const bool passes = (to_body - nearest * along).norm() < radius_m;
        const bool met = (before.range_m * along - to_body).norm() < radius_m;
        BeamState expected = before.state;
        if (before.state == BeamState::none && passes) expected = BeamState::unknown;
        if (before.state == BeamState::range && met) expected = BeamState::uav;
        ASSERT_EQ(beams.beams[static_cast<std::size_t>(i)].state, expected) << draw << ", beam " << i;
        marked += expected != before.state;
      }
    }
  }
  EXPECT_GT(marked, 10'000U);
}

}  // namespace
}  // namespace skein::agent
