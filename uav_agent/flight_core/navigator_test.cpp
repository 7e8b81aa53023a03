// Goals at random places: each gets exactly one outcome, and the right one.
#include "uav_agent/flight_core/navigator.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

constexpr int kTwoMinutes = 2400;  ///< in exchanges

AgentConfig two_explorers() {
  AgentConfig agent;
  agent.fleet = {{.name = "a"}, {.name = "b", .p_WB_start = {0.0, 60.0, 0.0}}};
  return agent;
}

struct InAClearing : FlownUav {
  explicit InAClearing(const Vector3d& at_W = {0.0, 0.0, 10.0}) : FlownUav(two_explorers(), at_W) {
    clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
  }
};

Vector3d drawn_place(RandomStream& random) {
  return {random.uniform(-18.0, 18.0), random.uniform(-18.0, 18.0), random.uniform(4.0, 18.0)};
}

TEST(Navigator, FliesToAGoalAndAlongItsWay) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RandomStream random(seed, "goals", 0);
    InAClearing uav;
    Goal goal{.id = 7};
    for (std::uint64_t i = random.bits() % 3 + 1; i > 0; --i) {
      goal.way.push_back({drawn_place(random), random.uniform(1.0, 5.0)});
    }
    uav.navigator.want({goal});
    const auto outcomes = uav.navigate(kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 1U) << "seed " << seed;
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::reached) << "seed " << seed;
    EXPECT_EQ(outcomes[0].id, 7);
    EXPECT_LT((uav.state.p_WB - goal.way.back().p_WB).norm(), 0.1);
    EXPECT_LT(uav.state.v_WB.norm(), 0.01) << "at rest";
    EXPECT_TRUE(uav.navigator.idle());
  }
}

// The first place is in the midst of structure. The navigator reports this at once, and takes the next goal.
TEST(Navigator, TakesTheFirstGoalToWhichThereIsAWay) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    RandomStream random(seed, "ranked", 0);
    InAClearing uav({-20.0, -20.0, 10.0});
    const Vector3d inside_W(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), random.uniform(3.0, 9.0));
    uav.build(inside_W - Vector3d::Constant(2.0), inside_W + Vector3d::Constant(2.0));
    const Vector3d behind_W(18.0, 18.0, random.uniform(5.0, 15.0));
    uav.navigator.want({{.id = 1, .way = {{inside_W, 3.0}}},
                        {.id = 2, .way = {{behind_W, 3.0}}},
                        {.id = 3, .way = {{inside_W, 3.0}}}});
    const auto outcomes = uav.navigate(kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 3U) << "seed " << seed;
    for (const std::size_t i : {0U, 1U, 2U}) EXPECT_EQ(outcomes[i].id, static_cast<std::int64_t>(i + 1));
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::no_way);
    EXPECT_EQ(outcomes[1].kind, Outcome::Kind::reached);
    EXPECT_EQ(outcomes[2].kind, Outcome::Kind::no_way);
    EXPECT_EQ(uav.navigator.missed_W(), inside_W);
  }
}

// No beam proves the space at the goal free, and the UAV must not wait for ever.
TEST(Navigator, GivesUpAGoalInSpaceThatIsNeverProved) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "never", 0);
    InAClearing uav;
    const double heading = random.uniform(-3.1, 3.1);
    const Vector3d out_W(45.0 * std::cos(heading), 45.0 * std::sin(heading), random.uniform(6.0, 18.0));
    uav.navigator.want({{.id = 5, .way = {{out_W, 5.0}}}});
    const auto outcomes = uav.navigate(2 * kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 1U) << "seed " << seed;
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::no_way);
    EXPECT_EQ(uav.navigator.missed_W(), out_W);
    EXPECT_TRUE(uav.filter.proved(uav.state.p_WB, uav.map, {})) << "it stays in the clearing";
  }
}

TEST(Navigator, SaysWhichLegIsBlocked) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    RandomStream random(seed, "blocked", 0);
    InAClearing uav({-18.0, 0.0, 10.0});
    Goal goal{.id = 3, .way = {{{-16.0, 0.0, 10.0}, 2.0}, {{-6.0, 0.0, 10.0}, 2.0}, {{16.0, 0.0, 10.0}, 2.0}}};
    uav.navigator.want({goal});
    while (!uav.navigator.on_way()) uav.navigate();
    for (std::uint64_t i = random.bits() % 160; i > 0; --i) uav.navigate();
    const double wall_m = random.uniform(4.0, 10.0);
    uav.build({wall_m, -20.0, 0.0}, {wall_m + 1.0, 20.0, 20.0});
    const auto outcomes = uav.navigate(kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 1U) << "seed " << seed;
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::blocked) << "seed " << seed;
    const double x_m = uav.tracker.tracking().setpoint.p_WB.x();
    if (std::abs(x_m + 6.0) < 1.0) continue;  // near the second waypoint, both legs are right
    EXPECT_EQ(outcomes[0].leg, x_m < -6.0 ? 1U : 2U) << "seed " << seed;
    EXPECT_LT(uav.state.p_WB.x(), wall_m - 1.7);
  }
}

// A planner may withdraw all goals while the UAV flies along one. FlightCore reads current() if on_way() holds.
TEST(Navigator, IsNotOnAWayAfterThePlannerHasWithdrawnAllGoals) {
  InAClearing uav;
  uav.navigator.want({{.id = 3, .way = {{{2.0, 0.0, 10.0}, 2.0}, {{9.0, 0.0, 10.0}, 2.0}, {{16.0, 0.0, 10.0}, 2.0}}}});
  while (!uav.navigator.on_way() || uav.navigator.leg() < 2) uav.navigate();
  uav.navigator.want({});
  EXPECT_FALSE(uav.navigator.on_way());
  uav.navigate();
  EXPECT_FALSE(uav.navigator.on_way());
  EXPECT_FALSE(uav.navigator.current());
}

// The navigator takes a strategy's changes of the same goal at any time.
TEST(Navigator, AWayMayChangeWhileItIsFlown) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    RandomStream random(seed, "changes", 0);
    InAClearing uav;
    Goal goal{.id = 9, .way = {{drawn_place(random), 3.0}, {drawn_place(random), 3.0}}};
    uav.navigator.want({goal});
    for (std::uint64_t i = random.bits() % 200; i > 0; --i) uav.navigate();
    if (uav.navigator.idle()) continue;
    uav.navigator.take_outcomes();
    goal.way = {{drawn_place(random), 3.0}, {drawn_place(random), 3.0}};
    uav.navigator.want({goal});
    const auto outcomes = uav.navigate(kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 1U) << "seed " << seed;
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::reached) << "seed " << seed;
    EXPECT_LT((uav.state.p_WB - goal.way.back().p_WB).norm(), 0.1) << "seed " << seed;
  }
}

// Without its LiDAR, no beam proves space ahead of the UAV. The navigator then searches for paths through known space
// only, and reports at once if there is none. When the LiDAR works again, it plans as before.
TEST(Navigator, WithoutItsLidarItPlansThroughProvedSpaceAlone) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "blind", 0);
    InAClearing uav;
    const double heading = random.uniform(-3.1, 3.1);
    const Goal outside{.id = 1, .way = {{Vector3d(45.0 * std::cos(heading), 45.0 * std::sin(heading), 12.0), 5.0}}};
    const Goal inside{.id = 2, .way = {{drawn_place(random), 3.0}}};
    uav.lidar_works = false;
    uav.navigate(100);
    for (int i = 0; i < 100; ++i) uav.navigate();
    EXPECT_FALSE(uav.navigator.sees());
    const Vector3d from_W = uav.state.p_WB;
    uav.navigator.want({outside});
    auto outcomes = uav.navigate(kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 1U) << "seed " << seed;
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::no_way);
    EXPECT_LT((uav.state.p_WB - from_W).norm(), 0.1) << "it did not set out";
    uav.navigator.want({inside});
    outcomes = uav.navigate(kTwoMinutes);
    ASSERT_EQ(outcomes.size(), 1U) << "seed " << seed;
    EXPECT_EQ(outcomes[0].kind, Outcome::Kind::reached);
    uav.lidar_works = true;
    const Vector3d again_W = uav.state.p_WB;
    uav.navigator.want({outside});
    uav.navigate(kTwoMinutes);
    EXPECT_TRUE(uav.navigator.sees());
    EXPECT_GT((uav.state.p_WB - again_W).norm(), 3.0)
        << "it flies to the end of free space, where its beams might prove more";
  }
}

// Another UAV hovers right on the straight line: there is room to fly about it.
TEST(Navigator, FindsAWayAroundAUavThatStays) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, "stays", 0);
    InAClearing uav({-18.0, 0.0, 10.0});
    const Vector3d stays_W(random.uniform(-8.0, 8.0), random.uniform(-1.0, 1.0), random.uniform(9.0, 11.0));
    const Vector3d to_W(18.0, 0.0, 10.0);
    uav.navigator.want({{.id = 1, .way = {{to_W, 4.0}}}});
    double nearest_m = 1e9;
    for (int i = 0; i < kTwoMinutes && !uav.navigator.idle(); ++i) {
      uav.peers.update(uav.input().tick, {{node_of_uav(UavIndex(1)), stays_W, Vector3d(Vector3d::Zero())}});
      uav.navigate();
      nearest_m = std::min(nearest_m, (uav.state.p_WB - stays_W).norm());
    }
    EXPECT_LT((uav.state.p_WB - to_W).norm(), 0.1) << "seed " << seed;
    EXPECT_GT(nearest_m, 2 * 0.63 + 0.5) << "seed " << seed;
  }
}

// The map has one distance to structure for each cube. A path along the border of two cubes, and a UAV a few
// centimetres beside it, must not look like structure that was not there before.
TEST(Navigator, FindsNoNewStructureWhereThereIsNone) {
  std::size_t reached = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "nothing_new", 0);
    InAClearing uav;
    for (int pillars = 0; pillars < 8;) {
      const Vector3d low_W(std::floor(random.uniform(-18.0, 16.0)), std::floor(random.uniform(-18.0, 16.0)), 0.0);
      if (low_W.head<2>().norm() < 6.0) continue;
      uav.build(low_W, low_W + Vector3d(1.9, 1.9, 24.0));
      ++pillars;
    }
    for (std::int64_t id = 1; id <= 12; ++id) {
      uav.navigator.want({{.id = id, .way = {{drawn_place(random), 4.0}}}});
      // Every other flight ends where the UAV happens to be, and not in the middle of a cube.
      const auto outcomes = uav.navigate(id % 2 == 0 ? kTwoMinutes : 20 + static_cast<int>(random.bits() % 100));
      for (const Outcome& outcome : outcomes) {
        EXPECT_NE(outcome.reason, "something was seen on the way") << "seed " << seed << ", goal " << id;
        reached += outcome.kind == Outcome::Kind::reached;
      }
    }
  }
  EXPECT_GT(reached, 100U);
}

}  // namespace
}  // namespace skein::agent
