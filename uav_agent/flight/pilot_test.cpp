#include "uav_agent/flight/pilot.hpp"

#include <gtest/gtest.h>

#include "uav_agent/testing/look_around.hpp"

namespace skein::agent {
namespace {

constexpr double kClearanceM = 1.8;

AgentConfig one_uav() {
  AgentConfig agent;
  agent.fleet = {{.name = "a", .body_radius_m = 0.4}};
  return agent;
}

/// A wall in the plane x = `x`.
OccupancyMap wall_at(float x) {
  std::vector<Eigen::Vector3f> hits;
  for (float y = -10.0F; y <= 60.0F; y += 0.4F) {
    for (float z = 0.6F; z <= 40.0F; z += 0.4F) hits.emplace_back(x, y, z);
  }
  OccupancyMap map;
  map.insert(hits, std::nullopt);
  return map;
}

/// One pilot that flies along a wall, four metres off it, and what it says of a UAV with another state.
class AlongAWall : public testing::Test {
 protected:
  template <class Do>
  auto as_input(const Setpoint& setpoint, const RigidBodyState& state, const Do& act) {
    TrackingState tracking;
    tracking.setpoint = setpoint;
    tracking.done = done_;
    tracking.leg = leg_;
    tracking.airborne = true;
    const PlannerInput in{.k = k_,
                          .tick = 80,
                          .state = state,
                          .gimbal = {},
                          .tracking = tracking,
                          .map = map_,
                          .boxes = boxes_,
                          .peers = peers_,
                          .mission_remaining_s = {},
                          .detected = {},
                          .radio = {}};
    return act(in);
  }
  Situation look(Pilot& pilot, const Setpoint& setpoint, const RigidBodyState& state, PlannerOutput& out) {
    return as_input(setpoint, state, [&](const PlannerInput& in) {
      return pilot.look_out(in, {.clearance_m = kClearanceM}, true, out);
    });
  }
  /// Through one place after the other, at 4 m/s.   @returns what it is told to fly at to each.
  std::vector<double> speeds_of(const std::vector<Vector3d>& places_W) {
    Path path;
    for (const Vector3d& p_W : places_W) path.waypoints.push_back({p_W, 4.0});
    Pilot pilot({}, agent_);
    PlannerOutput out;
    as_input({.p_WB = {0.0, 0.0, 20.0}}, {}, [&](const PlannerInput& in) { pilot.follow(path, in, out); });
    std::vector<double> speeds;
    for (const Waypoint& waypoint : std::get<Path>(out.motion).waypoints) speeds.push_back(waypoint.speed_mps);
    return speeds;
  }
  Situation judge(const RigidBodyState& state) {
    Pilot pilot({}, agent_);
    PlannerOutput out;
    const Setpoint setpoint{.p_WB = {0.0, 5.0, 20.0}, .v_WB = {0.0, 4.0, 0.0}};
    const Path path{{{{0.0, 40.0, 20.0}, 4.0}}};
    as_input(setpoint, state, [&](const PlannerInput& in) { pilot.follow(path, in, out); });
    return look(pilot, setpoint, state, out);
  }
  static RigidBodyState at(const Vector3d& p_W, const Vector3d& v_W) {
    RigidBodyState state;
    state.p_WB = p_W;
    state.v_WB = v_W;
    return state;
  }

  const AgentConfig agent_ = one_uav();
  const Peers peers_{agent_};
  bool done_ = false;
  std::size_t leg_ = 0;  ///< of the path that it was on
  std::uint64_t k_ = 4;
  std::vector<OrientedBox> boxes_;
  OccupancyMap map_ = wall_at(4.0F);
};

TEST_F(AlongAWall, FliesOnWhileItFollows) {
  EXPECT_EQ(judge(at({0.0, 4.2, 20.0}, {0.0, 4.0, 0.0})), Situation::flying_on);
}

TEST_F(AlongAWall, StopsWhenItsVelocityCarriesItTowardsTheWall) {
  EXPECT_EQ(judge(at({1.7, 4.2, 20.0}, {3.5, 2.0, 0.0})), Situation::obstacle);
}

TEST_F(AlongAWall, StopsWhenItIsOffItsSetpointAndNearer) {
  EXPECT_EQ(judge(at({2.4, 5.0, 20.0}, {1.5, 4.0, 0.0})), Situation::obstacle);
}

TEST_F(AlongAWall, MayLeaveAWallThatItIsTooNearTo) {
  EXPECT_EQ(judge(at({3.0, 5.0, 20.0}, {-1.0, 4.0, 0.0})), Situation::flying_on);
}

/// As often as it is told to: else it would come nearer each time.
TEST_F(AlongAWall, WhoStandsDoesNotLeaveTowardsTheWallAndSaysWhatFor) {
  done_ = true;
  for (const double x : {-1.0, 1.0, 2.6, 3.0, 3.3}) {
    Pilot pilot({}, agent_);
    const Setpoint here{.p_WB = {x, 5.0, 20.0}};
    const RigidBodyState stands = at(here.p_WB, Vector3d::Zero());
    PlannerOutput first, towards, next, away;
    look(pilot, here, stands, first);
    as_input(here, stands, [&](const PlannerInput& in) { pilot.follow({{{{10.0, 5.0, 20.0}, 2.0}}}, in, towards); });
    EXPECT_TRUE(std::holds_alternative<Hold>(towards.motion)) << x;
    ++k_;
    EXPECT_EQ(look(pilot, here, stands, next), Situation::obstacle) << x;
    EXPECT_FALSE(pilot.has_path());
    as_input(here, stands, [&](const PlannerInput& in) { pilot.follow({{{{-9.0, 5.0, 20.0}, 2.0}}}, in, away); });
    EXPECT_TRUE(std::holds_alternative<Path>(away.motion)) << x;
    k_ += 3;
  }
}

TEST_F(AlongAWall, WhatItLeavesForIsAllOfTheNewPath) {
  done_ = true;
  leg_ = 1;
  Pilot pilot({}, agent_);
  const Setpoint here{.p_WB = {1.0, 5.0, 20.0}};
  const RigidBodyState stands = at(here.p_WB, Vector3d::Zero());
  const Path round_it{{{{-9.0, 5.0, 20.0}, 2.0}, {{10.0, 5.0, 20.0}, 2.0}}};
  PlannerOutput first, out;
  look(pilot, here, stands, first);
  as_input(here, stands, [&](const PlannerInput& in) { pilot.follow(round_it, in, out); });
  EXPECT_TRUE(std::holds_alternative<Path>(out.motion));
}

/// Attempts along the wall, each of which ends a little nearer to it: not as many as it likes.
TEST_F(AlongAWall, NobodyComesNearerAttemptByAttempt) {
  done_ = true;
  Pilot pilot({}, agent_);
  double x = 2.7;
  int attempts = 0;
  for (; attempts < 60; ++attempts) {
    const Setpoint here{.p_WB = {x, 5.0, 20.0}};
    const RigidBodyState stands = at(here.p_WB, Vector3d::Zero());
    PlannerOutput out;
    look(pilot, here, stands, out);
    as_input(here, stands, [&](const PlannerInput& in) { pilot.follow({{{{x + 0.02, 40.0, 20.0}, 2.0}}}, in, out); });
    if (!std::holds_alternative<Path>(out.motion)) break;
    pilot.stop(out);
    x += 0.02;
    ++k_;
  }
  EXPECT_LT(attempts, 25);
  EXPECT_LT(x, 3.2);
  const Setpoint here{.p_WB = {x, 5.0, 20.0}};
  PlannerOutput away;
  as_input(here, at(here.p_WB, Vector3d::Zero()), [&](const PlannerInput& in) {
    pilot.follow({{{{-9.0, 5.0, 20.0}, 2.0}}}, in, away);
  });
  EXPECT_TRUE(std::holds_alternative<Path>(away.motion)) << "but it may leave";
}

TEST_F(AlongAWall, WhoSetsOutTowardsTheWallIsStoppedInTheNextExchange) {
  for (k_ = 4; k_ < 8; ++k_) {
    Pilot pilot({}, agent_);
    PlannerOutput sets_out, out;
    const Setpoint setpoint{.p_WB = {1.0, 5.0, 20.0}};
    const Path path{{{{10.0, 5.0, 20.0}, 2.0}}};
    as_input(setpoint, {}, [&](const PlannerInput& in) { pilot.follow(path, in, sets_out); });
    EXPECT_EQ(look(pilot, setpoint, at({1.0, 5.0, 20.0}, Vector3d::Zero()), out), Situation::obstacle) << k_;
  }
}

TEST_F(AlongAWall, WhoIsStoppedStandsAlsoWhereItHasJustSetOut) {
  Pilot pilot({}, agent_);
  PlannerOutput out;
  const Path path{{{{0.0, 40.0, 20.0}, 4.0}}};
  as_input({.p_WB = {0.0, 5.0, 20.0}}, {}, [&](const PlannerInput& in) { pilot.follow(path, in, out); });
  pilot.stop(out);
  EXPECT_FALSE(pilot.has_path());
  EXPECT_TRUE(std::holds_alternative<Hold>(out.motion)) << "it would fly on, and nobody would look out";
}

TEST_F(AlongAWall, SaysWhyThereIsNoWay) {
  const auto fly_to = [&](const Vector3d& goal, const std::vector<OrientedBox>& boxes, PlannerOutput& out) {
    TrackingState tracking;
    tracking.setpoint = {.p_WB = {0.0, 5.0, 20.0}};
    const PlannerInput in{.k = 4,
                          .tick = 80,
                          .state = at({0.0, 5.0, 20.0}, Vector3d::Zero()),
                          .gimbal = {},
                          .tracking = tracking,
                          .map = map_,
                          .boxes = boxes,
                          .peers = peers_,
                          .mission_remaining_s = {},
                          .detected = {},
                          .radio = {}};
    return Pilot({}, agent_).fly_to(goal, in, {.clearance_m = kClearanceM}, out);
  };
  OrientedBox box;
  box.center = {-30.0, 5.0, 20.0};
  box.size = {8.0, 8.0, 8.0};
  const std::vector<std::pair<Vector3d, Barrier>> barred = {
      {{0.0, 10.0, 1.0}, Barrier::floor}, {{3.5, 10.0, 20.0}, Barrier::mapped}, {box.center, Barrier::unseen}};
  for (const auto& [goal, barrier] : barred) {
    PlannerOutput out;
    const Way way = fly_to(goal, {box}, out);
    EXPECT_FALSE(way);
    EXPECT_EQ(way.at_goal, barrier) << to_string(way.at_goal);
    EXPECT_NE(way.why().find(to_string(barrier)), std::string::npos) << way.why();
    EXPECT_EQ(out.no_way, way.why());
    EXPECT_TRUE(std::holds_alternative<std::monostate>(out.motion)) << "and does nothing";
  }
  PlannerOutput out;
  EXPECT_FALSE(fly_to(box.center, {box}, out));
  const Way way = fly_to({-10.0, 20.0, 20.0}, {box}, out);
  EXPECT_EQ(out.no_way, "") << "there was another way";
  EXPECT_TRUE(way) << way.why();
  EXPECT_TRUE(std::holds_alternative<Path>(out.motion));
}

TEST_F(AlongAWall, FliesSlowlyInBoxesWhereLittleWasSeen) {
  OrientedBox box;
  box.center = {0.0, 20.0, 20.0};
  box.size = {10.0, 10.0, 40.0};
  boxes_ = {box};
  const std::vector<Vector3d> places_W = {{0, 8, 20}, {0, 20, 20}, {0, 40, 20}, {0, 60, 20}};
  const std::vector<double> unseen = {4.0, 2.0, 2.0, 4.0}, seen = {4.0, 4.0, 4.0, 4.0};
  EXPECT_EQ(speeds_of(places_W), unseen);
  look_around(map_, {0, 14, 20}, 80);
  look_around(map_, {0, 26, 20}, 80);
  EXPECT_EQ(speeds_of(places_W), seen);
}

TEST_F(AlongAWall, TheNextRetreatGoesFartherBack) {
  Pilot pilot({}, agent_);
  double y = 0.0;
  const auto fly_to = [&](double goal) {
    while (y != goal) {
      y = goal > y ? std::min(goal, y + 0.5) : std::max(goal, y - 0.5);
      PlannerOutput out;
      look(pilot, {.p_WB = {0.0, y, 20.0}}, at({0.0, y, 20.0}, Vector3d::Zero()), out);
    }
  };
  fly_to(50.0);
  double before = y;
  for (int i = 0; i < 3; ++i) {
    PlannerOutput out;
    as_input({.p_WB = {0.0, y, 20.0}}, at({0.0, y, 20.0}, Vector3d::Zero()),
             [&](const PlannerInput& in) { ASSERT_TRUE(pilot.retreat(in, out, false)); });
    fly_to(std::get<Path>(out.motion).waypoints.back().p_WB.y());
    EXPECT_LT(y, before - 8.0);
    before = y;
    pilot.stop(out);
  }
}

}  // namespace
}  // namespace skein::agent
