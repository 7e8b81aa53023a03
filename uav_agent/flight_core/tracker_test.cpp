#include "uav_agent/flight_core/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kDtS = 0.05;

constexpr double kSmoothingS = 0.5, kSinkMps2 = 2.0;

Tracker::Config limits() {
  return {.max_speed_mps = 6.0,
          .max_acceleration_mps2 = 2.8,
          .max_sink_acceleration_mps2 = kSinkMps2,
          .smoothing_s = kSmoothingS};
}

double distance_to_polyline(const Vector3d& p, const std::vector<Vector3d>& line) {
  double best = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector3d ab = line[i] - line[i - 1];
    const double t =
        ab.squaredNorm() < 1e-12 ? 0.0 : std::clamp((p - line[i - 1]).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - line[i - 1] - t * ab).norm());
  }
  return best;
}

/// A UAV that follows its commands exactly.
struct PerfectUav {
  RigidBodyState state;
  Tracker tracker{limits()};
  TrajectoryCommand last{.p_WB = Vector3d(0.0, 0.0, 10.0)};

  explicit PerfectUav(const Vector3d& start) {
    state.p_WB = start;
    last.p_WB = start;
  }
  TrajectoryCommand step() {
    const TrajectoryCommand now = *tracker.step(state, kDtS);
    const TrajectoryCommand before = last;
    EXPECT_LE(now.v_WB.norm(), 6.0 + 1e-9);
    EXPECT_LE(now.a_WB.norm(), 2.8 + 1e-9);
    EXPECT_GE(now.a_WB.z(), -kSinkMps2 - 1e-9);
    EXPECT_LE((now.a_WB - before.a_WB).norm(), 2.0 * 2.8 * kDtS / kSmoothingS + 1e-9) << "the jerk is limited";
    EXPECT_NEAR((before.v_WB + now.a_WB * kDtS - now.v_WB).norm(), 0.0, 0.06)
        << "the acceleration is the change of velocity";
    EXPECT_NEAR((before.p_WB + 0.5 * (before.v_WB + now.v_WB) * kDtS - now.p_WB).norm(), 0.0, 0.02);
    last = now;
    state.p_WB = now.p_WB;
    state.v_WB = now.v_WB;
    return now;
  }
};

TEST(Tracker, CommandsNothingBeforeTheFirstMotion) {
  Tracker tracker(limits());
  EXPECT_FALSE(tracker.step({}, kDtS));
  EXPECT_FALSE(tracker.tracking().airborne);
}

// For every polyline, the UAV keeps its limits, the line and each leg's speed, and reaches the end exactly.
TEST(Tracker, FollowsRandomPolylines) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "polyline", 0);
    PerfectUav uav({random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), 20.0});
    std::vector<Vector3d> line = {uav.state.p_WB};
    Path path;
    const int corners = 1 + static_cast<int>(random.bits() % 7);
    for (int i = 0; i < corners; ++i) {
      const double size = random.uniform() < 0.3 ? 0.4 : 15.0;  // short legs, too
      const Vector3d p =
          line.back() + Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
      line.push_back(p);
      path.waypoints.push_back({p, random.uniform(0.5, 5.5)});
    }
    uav.tracker.follow(path);
    int steps = 0;
    std::size_t leg = 0;
    while (steps++ < 6000) {
      const auto now = uav.step();
      ASSERT_LT(distance_to_polyline(now.p_WB, line), 0.6) << "seed " << seed;
      const auto tracking = uav.tracker.tracking();
      ASSERT_GE(tracking.leg, leg);
      leg = tracking.leg;
      if (tracking.done) break;
    }
    EXPECT_LT(steps, 6000) << "seed " << seed << " never arrives";
    EXPECT_EQ(leg, path.waypoints.size());
    EXPECT_NEAR((uav.last.p_WB - line.back()).norm(), 0.0, 1e-9);
    EXPECT_EQ(uav.last.v_WB, Vector3d::Zero());
  }
}

// With longer exchanges, the tracker flies the same path as fast. Each command is where a tracker with exchanges of the
// usual length would be by then.
TEST(Tracker, ALongExchangeTakesTheSameWayInTheSameTime) {
  for (const int pace : {2, 4, 5, 10, 20}) {
    RandomStream random(static_cast<std::uint64_t>(pace), "polyline", 0);
    Path path;
    for (int i = 0; i < 5; ++i) {
      path.waypoints.push_back({{random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), 20.0 + 2.0 * i}, 4.0});
    }
    const auto obey = [](Tracker& tracker, RigidBodyState& state, double dt_s) {
      const TrajectoryCommand command = *tracker.step(state, dt_s);
      state.p_WB = command.p_WB;
      state.v_WB = command.v_WB;
    };
    Tracker usual(limits()), slow(limits());
    RigidBodyState usual_state, slow_state;
    usual.follow(path);
    slow.follow(path);
    for (int i = 0; i < 1200 / pace && !usual.tracking().done; ++i) {
      for (int k = 0; k < pace; ++k) obey(usual, usual_state, kDtS);
      obey(slow, slow_state, pace * kDtS);
      ASSERT_LT((usual_state.p_WB - slow_state.p_WB).norm(), 1e-6) << pace << ", step " << i;
      ASSERT_LT((usual_state.v_WB - slow_state.v_WB).norm(), 1e-6) << pace << ", step " << i;
    }
    EXPECT_TRUE(usual.tracking().done && slow.tracking().done) << pace;
  }
}

TEST(Tracker, KeepsTheSpeedOfEachLegAndUsesIt) {
  PerfectUav uav({0.0, 0.0, 10.0});
  uav.tracker.follow({{{{30.0, 0.0, 10.0}, 2.0}, {{90.0, 0.0, 10.0}, 5.0}}});
  double fastest_first = 0.0, fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const auto now = uav.step();
    if (now.p_WB.x() < 29.0) fastest_first = std::max(fastest_first, now.v_WB.norm());
    fastest = std::max(fastest, now.v_WB.norm());
  }
  EXPECT_NEAR(fastest_first, 2.0, 0.05);
  EXPECT_NEAR(fastest, 5.0, 0.05);
}

TEST(Tracker, APathMayBeReplacedAtAnyTime) {
  RandomStream random(5, "replace", 0);
  PerfectUav uav({0.0, 0.0, 30.0});
  for (int i = 0; i < 600; ++i) {
    if (i % 7 == 0) {
      const Vector3d p(random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0), random.uniform(10.0, 50.0));
      uav.tracker.follow({{{p, 5.0}}});
    }
    if (i % 50 == 49) uav.tracker.hold();
    uav.step();  // checks limits and that nothing jumps
  }
}

TEST(Tracker, HoldStopsWithinTheBrakingDistance) {
  PerfectUav uav({0.0, 0.0, 10.0});
  uav.tracker.follow({{{{100.0, 0.0, 10.0}, 6.0}}});
  while (uav.last.v_WB.norm() < 5.9) uav.step();
  const Vector3d from = uav.last.p_WB;
  uav.tracker.hold();
  for (int i = 0; i < 80; ++i) uav.step();
  EXPECT_EQ(uav.last.v_WB, Vector3d::Zero());
  EXPECT_LT((uav.last.p_WB - from).norm(), 6.0 * 6.0 / (2.0 * 2.8) + 0.5 * kSmoothingS * 6.0 + 0.1);
}

// The tracker looks ahead from the position of the point mass, so no setpoint is beyond the stop.
TEST(Tracker, AStopEndsWithinTheBrakingDistanceAndStaysOnTheLine) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, "stop", 0);
    PerfectUav uav({0.0, 0.0, 40.0});
    const Vector3d direction =
        Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)).normalized();
    uav.tracker.follow({{{uav.state.p_WB + 60.0 * direction, random.uniform(1.0, 6.0)}}});
    const int steps = 5 + static_cast<int>(random.bits() % 80);
    for (int i = 0; i < steps; ++i) uav.step();
    const Setpoint mass = uav.tracker.tracking().setpoint;
    uav.tracker.hold();
    for (int i = 0; i < 100; ++i) {
      uav.step();
      const double ahead = (uav.last.p_WB - mass.p_WB).dot(direction);
      const double braking = direction.z() > 0.0 ? std::min(2.8, kSinkMps2 / direction.z()) : 2.8;
      ASSERT_LT(ahead, mass.v_WB.squaredNorm() / (2.0 * braking) + 0.01) << "seed " << seed;
    }
    EXPECT_TRUE(uav.last.v_WB.isZero(0.0));
    EXPECT_LT((uav.last.p_WB - Vector3d(0.0, 0.0, 40.0)).cross(direction).norm(), 1e-6);
  }
}

TEST(Tracker, IsNotDoneBeforeTheCommandedStateIsAtRest) {
  PerfectUav uav({0.0, 0.0, 10.0});
  uav.tracker.follow({{{{12.0, 0.0, 10.0}, 4.0}}});
  while (!uav.tracker.tracking().done) uav.step();
  EXPECT_TRUE(uav.last.v_WB.isZero(0.0));
  EXPECT_EQ(uav.last.p_WB, Vector3d(12.0, 0.0, 10.0));
}

TEST(Tracker, ContinuesSmoothlyFromASetpointOfThePlanner) {
  PerfectUav uav({0.0, 0.0, 20.0});
  const Vector3d v(3.0, 0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    uav.tracker.fly_to({.p_WB = Vector3d(0.0, 0.0, 20.0) + i * kDtS * v, .v_WB = v});
    uav.last.v_WB = v;
    uav.last.p_WB = Vector3d(0.0, 0.0, 20.0) + (i - 1) * kDtS * v;
    uav.step();
  }
  uav.tracker.hold();
  for (int i = 0; i < 60; ++i) uav.step();  // checks that nothing jumps
  EXPECT_TRUE(uav.last.v_WB.isZero(0.0));
}

TEST(Tracker, WaitsForAUavThatDoesNotMoveAndStartsAnewWhenItIsLost) {
  Tracker tracker(limits());
  RigidBodyState state;
  state.p_WB = {0.0, 0.0, 0.1};
  tracker.follow({{{{0.0, 0.0, 30.0}, 2.5}}});
  for (int i = 0; i < 20; ++i) tracker.step(state, kDtS);  // motors do not start for a second
  EXPECT_LT((tracker.tracking().setpoint.p_WB - state.p_WB).norm(), 1.5);
  state.p_WB = {40.0, 0.0, 12.0};
  const auto command = tracker.step(state, kDtS);
  EXPECT_LT((command->p_WB - state.p_WB).norm(), 0.2);
  EXPECT_FALSE(tracker.tracking().done) << "the path is not forgotten";
}

TEST(Tracker, YawTurnsAtALimitedRateTheShortWay) {
  PerfectUav uav({0.0, 0.0, 10.0});
  uav.tracker.hold();
  uav.tracker.turn_to(3.0);
  uav.step();
  for (int i = 0; i < 200; ++i) uav.step();
  uav.tracker.turn_to(-3.0);
  double before = uav.last.yaw;
  for (int i = 0; i < 40; ++i) {
    const double now = uav.step().yaw;
    EXPECT_LE(std::abs(std::remainder(now - before, 2.0 * M_PI)), 0.8 * kDtS + 1e-9);
    EXPECT_GT(std::abs(now), 2.9) << "it turns through the back, not through zero";
    before = now;
  }
  EXPECT_NEAR(before, -3.0, 1e-9);
}

TEST(Tracker, NeverCommandsTheOriginBecauseItMeansNoPosition) {
  PerfectUav uav({0.0, 0.0, 0.005});
  uav.tracker.hold();
  for (int i = 0; i < 5; ++i) EXPECT_GE(uav.tracker.step(uav.state, kDtS)->p_WB.norm(), 0.01);
}

TEST(Tracker, ASetpointOfThePlannerIsClampedToTheLimits) {
  Tracker tracker(limits());
  tracker.fly_to({.p_WB = {1.0, 2.0, 3.0}, .yaw = 0.5, .v_WB = {20.0, 0.0, 0.0}, .a_WB = {0.0, -9.0, 0.0}});
  const auto command = *tracker.step({}, kDtS);
  EXPECT_EQ(command.p_WB, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(command.yaw, 0.5);
  EXPECT_NEAR(command.v_WB.norm(), 6.0, 1e-9);
  EXPECT_NEAR(command.a_WB.norm(), 2.8, 1e-9);
}

}  // namespace
}  // namespace skein::agent
