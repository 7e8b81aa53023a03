// Compares the beams that the production LiDAR measured with those that a UAV reconstructs from the cloud, the servo's
// angle and its own odometry. Scenes, poses, flights and servo phases are random; with and without noise, motion
// distortion and lost returns, and with exchanges that do not coincide with scans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/random_stream.hpp"
#include "core/vehicle/lidar_geometry.hpp"
#include "sim_server/sensors/lidar.hpp"
#include "sim_server/sensors/lost_returns.hpp"
#include "tests/support/test_scenes.hpp"
#include "uav_agent/onboard/beam_reader.hpp"

namespace skein::sensing {
namespace {

using agent::BeamScan;
using agent::BeamState;
using agent::KnownBody;
using agent::ScanDoubt;

/// The motion of a body that sways, rises and turns.
class Sway {
 public:
  explicit Sway(RandomStream& random)
      : p_W_(sim::test::random_in_box(random, {-15.0, -15.0, 1.5}, {15.0, 15.0, 40.0})),
        swing_(sim::test::random_in_box(random, {0.1, 0.1, 0.1}, {0.8, 0.8, 0.3})),
        drift_(sim::test::random_in_box(random, {-4.0, -4.0, -0.5}, {4.0, 4.0, 1.0})),
        yaw_(random.uniform(-3.0, 3.0)),
        yaw_rate_(random.uniform(-1.5, 1.5)),
        tilt_(random.uniform(0.0, 0.15)),
        phase_(random.uniform(0.0, 6.0)) {}

  Isometry3d X_WB(double t) const {
    const double s = std::sin(2.5 * t + phase_), c = std::cos(2.5 * t + phase_);
    return Eigen::Translation3d(p_W_ + drift_ * t + swing_.cwiseProduct(Vector3d(s, c, s))) *
           Eigen::AngleAxisd(yaw_ + yaw_rate_ * t, Vector3d::UnitZ()) *
           Eigen::AngleAxisd(tilt_ * s, Vector3d(0.6, 0.8, 0.0));
  }
  RigidBodyState state(double t) const {
    const double h = 1e-4;
    const Isometry3d before = X_WB(t - h), now = X_WB(t), after = X_WB(t + h);
    const Eigen::AngleAxisd turn(Matrix3d(before.linear().transpose() * after.linear()));
    return {now.translation(), Quaterniond(now.linear()), (after.translation() - before.translation()) / (2.0 * h),
            turn.angle() * turn.axis() / (2.0 * h)};
  }

 private:
  Vector3d p_W_, swing_, drift_;
  double yaw_, yaw_rate_, tilt_, phase_;
};

constexpr UavIndex kSelf{0}, kOther{1};
constexpr double kBodyM = 0.95;  ///< radius of a sphere around the other UAV, with a margin

struct Case {
  double sigma_m = 0.0;
  bool distorted = false;
  Tick exchange = 20;  ///< ticks
  bool loses = false;  ///< whether the LiDAR loses returns
};

struct Outcome {
  std::size_t beams = 0, exact = 0, false_none = 0, none = 0, range = 0, near = 0, uav = 0, hidden = 0;
};

class BeamsThereAndBack : public testing::TestWithParam<Case> {
 protected:
  /// Draws boxes around the UAV, some below the LiDAR's least range, and another UAV.
  void draw(std::uint64_t key) {
    RandomStream random(key, "beams", 0);
    sway_.emplace(random);
    const Vector3d about = sway_->X_WB(0.5).translation();
    TriangleMesh mesh = sim::test::random_triangles(20, key);
    for (int i = 0; i < 12; ++i) {
      const Vector3d centre = about + random.uniform(0.4, 40.0) * sim::test::random_unit(random);
      sim::test::add_box(mesh, centre, sim::test::random_in_box(random, Vector3d::Constant(0.05), {0.2, 8.0, 6.0}),
                         sim::test::rotation(random.uniform(0.0, 3.0), 0.3, random.uniform(0.0, 3.0)));
    }
    world_.emplace(mesh, std::vector<sim::BodyShape>(2, sim::body_shape(VehicleConfig{})));
    other_ = about + random.uniform(3.0, 30.0) * sim::test::random_unit(random);
    other_.z() = std::max(other_.z(), 1.0);
    world_->set_pose(kOther, Isometry3d(Eigen::Translation3d(other_)));
    config_.sigma_m = GetParam().sigma_m;
    config_.motion_distortion = GetParam().distorted;
    if (GetParam().loses) {
      config_.no_return_p = 0.3;
      config_.dropped_sectors = {.share = 0.2, .width_deg = 30.0, .hold_s = 0.5};
    }
    config_.servo_period_s = key % 2 == 0 ? 8.0 : 0.66;
    // A fast servo reaches its stop, rests there for 22 ms and turns back, all between two scans.
    config_.servo_rate_deg_s = key % 3 == 0 ? 45.0 : 130.0;
    config_.servo_limit_deg = key % 2 == 0 ? 90.0 : 20.0;
    lidar_.emplace(config_, kSelf, key + 1);
    lost_.emplace(config_, kSelf, key + 1);
  }

  /// The ranges of the last scan; infinite: no return.
  std::vector<double> returned(Tick tick) {
    std::vector<double> ranges(lidar_->ranges().begin(), lidar_->ranges().end());
    const std::vector<bool>& lost = lost_->of(tick);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (lost[i]) ranges[i] = std::numeric_limits<double>::infinity();
    }
    return ranges;
  }

  /// Compares each beam with its measured range.
  void compare(const BeamScan& beams, const std::vector<double>& ranges) {
    for (int ring = 0; ring < config_.rings; ++ring) {
      for (int column = 0; column < config_.columns; ++column) {
        const auto i = static_cast<std::size_t>(ring * config_.columns + column);
        const bool returned = ranges[i] >= config_.range_min_m && ranges[i] <= config_.range_max_m;
        const BeamScan::Beam& beam = beams.beams[i];
        const double off = 7.0 * config_.sigma_m + 1e-3;
        const bool right_range = returned && std::abs(beam.range_m - ranges[i]) < off;
        bool exact = beam.state == (returned ? BeamState::range : BeamState::none) && (!returned || right_range);
        if (beam.state == BeamState::uav || beam.state == BeamState::unknown) {
          exact = concerns_other(beams, ring, column, returned ? ranges[i] : config_.range_max_m) &&
                  returned == (beam.state == BeamState::uav) && (!returned || right_range);
          ++(returned ? tally_.uav : tally_.hidden);
        }
        ++tally_.beams;
        tally_.exact += exact;
        tally_.false_none += beam.state == BeamState::none && returned;
        tally_.near += beam.state == BeamState::none && ranges[i] < config_.range_min_m;
        tally_.none += beam.state == BeamState::none;
        tally_.range += beam.state == BeamState::range;
      }
    }
  }

  /// Whether the beam hit or passed the other UAV's sphere, or came near it.
  bool concerns_other(const BeamScan& beams, int ring, int column, double range) const {
    const Isometry3d& X_WL = beams.firing(column).X_WL;
    const Vector3d along = X_WL.linear() * lidar_direction_L(config_, ring, column);
    const Vector3d to_other = other_ - X_WL.translation();
    const double nearest = std::clamp(to_other.dot(along), 0.0, range);
    return (to_other - nearest * along).norm() < kBodyM + 0.5;
  }

  RigidBodyState jumped(Tick tick, const Vector3d& by) const {
    RigidBodyState state = sway_->state(seconds(tick));
    state.p_WB += by;
    return state;
  }

  void expect_poses(const BeamScan& beams) const {
    const bool at_once = !config_.motion_distortion || beams.tick == 0;
    ASSERT_EQ(beams.fired.size(), at_once ? 1U : 40U);
    for (std::size_t i = 0; i < beams.fired.size(); ++i) {
      const BeamScan::Firing& firing = beams.fired[i];
      ASSERT_EQ(firing.first_column, 11 * static_cast<int>(i)) << "a scan has 40 ticks of 11 columns each";
      ASSERT_EQ(firing.tick, at_once ? beams.tick : beams.tick - 39 + static_cast<Tick>(i));
      const Isometry3d X_WL = lidar_pose(sway_->X_WB(seconds(firing.tick)), lidar_->servo(firing.tick).angle);
      const Isometry3d off = X_WL.inverse() * firing.X_WL;
      // The LiDAR is 0.2 m above the body's origin.
      ASSERT_LE(off.translation().norm(), firing.error_m + 0.21 * firing.error_rad + 1e-9);
      ASSERT_LE(Eigen::AngleAxisd(off.linear()).angle(), firing.error_rad + 1e-7);
    }
  }

  LidarConfig config_;
  std::optional<Sway> sway_;
  std::optional<sim::RayScene> world_;
  std::optional<sim::Lidar> lidar_;
  std::optional<sim::LostReturns> lost_;
  Vector3d other_ = Vector3d::Zero();
  Outcome tally_;
};

TEST_P(BeamsThereAndBack, EveryBeamIsReconstructedAsTheLidarMeasuredIt) {
  constexpr Tick kEnd = 560;
  struct Taken {
    agent::Scan scan;
    std::vector<double> ranges;
  };
  for (std::uint64_t key = 0; key < 12; ++key) {
    draw(key);
    agent::BeamReader reader(config_);
    std::vector<Taken> taken;
    for (Tick tick = 0; tick <= kEnd; ++tick) {
      const RigidBodyState state = sway_->state(seconds(tick));
      lidar_->move(tick, state.X_WB());
      if (lidar_->due(tick)) {
        const sim::LidarScan scan = lidar_->scan(tick, state.X_WB(), *world_);
        taken.push_back({{tick, scan.points_W}, returned(tick)});
        reader.hear(lidar_->servo(tick));
      }
      if (tick % GetParam().exchange != 0) continue;
      reader.hear(tick, state);
      for (const Taken& one : taken) {
        const BeamScan beams = reader.read(one.scan, std::vector{KnownBody{other_, kBodyM}});
        ASSERT_EQ(beams.doubt, ScanDoubt::none) << "scene " << key << ", tick " << one.scan.tick;
        ASSERT_EQ(beams.points, one.scan.points_W.size());
        ASSERT_EQ(beams.tick, one.scan.tick);
        compare(beams, one.ranges);
        expect_poses(beams);
      }
      taken.clear();
    }
  }
  EXPECT_EQ(tally_.false_none, 0U);
  EXPECT_GE(static_cast<double>(tally_.exact), 0.999 * static_cast<double>(tally_.beams));
  for (const std::size_t seen : {tally_.none, tally_.range, tally_.near, tally_.uav, tally_.hidden}) {
    EXPECT_GT(seen, 100U) << "a kind of beam is too rare in these scenes";
  }
  RecordProperty("exact", std::to_string(tally_.exact) + " of " + std::to_string(tally_.beams));
}

std::string name_of_case(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.sigma_m > 0.0 ? "Noisy" : "Clean") + (info.param.distorted ? "Distorted" : "Instant") +
         "Every" + std::to_string(info.param.exchange) + "Ticks" + (info.param.loses ? "WithLostReturns" : "");
}

INSTANTIATE_TEST_SUITE_P(Flights, BeamsThereAndBack,
                         testing::Values(Case{0.0, false, 20}, Case{0.03, false, 20}, Case{0.0, true, 20},
                                         Case{0.03, true, 20}, Case{0.03, false, 12}, Case{0.03, true, 12},
                                         Case{0.03, false, 20, true}, Case{0.03, true, 12, true}),
                         name_of_case);

// Odometry errors are like those of the faults odometry_jump and odometry_freeze.
TEST_P(BeamsThereAndBack, ScansWithFalseOdometryAreRejected) {
  std::size_t scans = 0;
  for (std::uint64_t key = 0; key < 12; ++key) {
    draw(key);
    const std::function<RigidBodyState(Tick)> kinds[] = {
        [&](Tick tick) {
          return jumped(tick, {0.3, 0.0, 0.0});
        },
        [&](Tick tick) {
          return jumped(tick, {-2.0, 5.0, 0.5});
        },
        [&](Tick tick) { return sway_->state(seconds(std::min<Tick>(tick, 20))); },
    };
    for (const auto& told : kinds) {
      agent::BeamReader reader(config_);
      for (Tick tick = 0; tick <= 80; ++tick) {
        lidar_->move(tick, sway_->X_WB(seconds(tick)));
        if (tick % 40 == 0) reader.hear(lidar_->servo(tick));
        if (tick % 20 == 0) reader.hear(tick, told(tick));
      }
      const sim::LidarScan scan = lidar_->scan(80, sway_->X_WB(seconds(80)), *world_);
      if (scan.points_W.size() < 5) continue;
      ++scans;
      EXPECT_EQ(reader.read({80, scan.points_W}, {}).doubt, ScanDoubt::misfit) << "scene " << key;
    }
  }
  EXPECT_GT(scans, 24U);
}

}  // namespace
}  // namespace skein::sensing
