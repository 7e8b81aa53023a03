// The outcomes of goals that the flight core reports to a strategy, whatever happens meanwhile.
#include "uav_agent/flight_core/flight_core.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/core_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

AgentConfig a_lone_explorer() {
  AgentConfig agent;
  agent.fleet = {{.name = "a"}};
  return agent;
}

/// A strategy that wants one place after the other: most of them inside structure, or where no beam proves anything.
struct WantsOnePlaceAfterTheOther : CoreUav {
  explicit WantsOnePlaceAfterTheOther(std::uint64_t seed)
      : CoreUav(a_lone_explorer(), {0.0, 0.0, 10.0}), random(seed, "outcomes", 0) {
    clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
    build({10.0, 10.0, 6.0}, {14.0, 14.0, 12.0});
    boxes = {make_box({12.0, 12.0, 9.0}, {6.0, 6.0, 8.0})};
  }
  Goal drawn_goal() {
    const double which = random.uniform();
    if (which < 0.3) return {.id = ++id, .way = {{Vector3d(12.0, 12.0, 9.0), 3.0}}};
    if (which < 0.6) return {.id = ++id, .way = {{Vector3d(60.0, random.uniform(-30.0, 30.0), 10.0), 3.0}}};
    return {
        .id = ++id,
        .way = {{Vector3d(random.uniform(-15.0, 5.0), random.uniform(-15.0, 5.0), random.uniform(4.0, 18.0)), 4.0}}};
  }
  void exchange() {
    PlannerInput in = input();
    core.update(in);
    in.flight = core.state();
    std::optional<std::vector<Goal>> goals;
    for (const Outcome& outcome : in.flight.outcomes) {
      if (in.flight.working && outcome.id == id) flying = false;
      ++outcomes;
    }
    forgotten = flying && in.flight.idle ? forgotten + 1 : 0;
    longest_forgotten = std::max(longest_forgotten, forgotten);
    if (in.flight.working && !flying) {
      goals = {drawn_goal()};
      flying = true;
    }
    const Steering steering = core.step(in, std::move(goals));
    note_doing(in);
    fly_by(steering);
  }
  /// The activity that the core shows to people must agree with the outcomes that it reports to its strategy.
  void note_doing(const PlannerInput& in) {
    using enum Doing::What;
    const Doing doing = core.doing(in);
    const auto& known = core.going_to_W();
    const bool to_goal_of_strategy = doing.what == to_goal || doing.what == along_goal;
    recovers = recovers || doing.what == looks_round || doing.what == back || doing.what == climbs;
    if (to_goal_of_strategy && (!doing.goal_W || doing.goal_W != known)) ++wrong;
    if (doing.what == no_goal && doing.goal_W) ++wrong;
    seen.insert(doing.what);
  }
  std::set<Doing::What> seen;
  bool recovers = false;
  int wrong = 0;
  RandomStream random;
  std::int64_t id = 0;
  bool flying = false;
  int outcomes = 0, forgotten = 0, longest_forgotten = 0;
};

// The last goal may end in the exchange in which a recovery begins, above all after the program was stopped for some
// seconds, because the UAV has then made no progress for long.
TEST(FlightCore, TheStrategyReceivesEachOutcomeWhenItDecides) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    WantsOnePlaceAfterTheOther uav(seed);
    for (int i = 0; i < 3000; ++i) {
      uav.exchange();
      if (uav.random.uniform() < 0.005) uav.k += 20 + uav.random.bits() % 300;  // the program is stopped for 1 to 16 s
    }
    EXPECT_GT(uav.outcomes, 2) << "seed " << seed;
    EXPECT_LE(uav.longest_forgotten, 1) << "seed " << seed;
    EXPECT_EQ(uav.wrong, 0) << "seed " << seed;
    EXPECT_TRUE(uav.seen.contains(Doing::What::to_goal)) << "seed " << seed;
    EXPECT_TRUE(uav.recovers) << "seed " << seed;
  }
}

// The strategy wants another far place every 1.5 s, and no beam proves the path free. The UAV nevertheless looks around
// and tries other places, and the core reports this to the strategy.
TEST(FlightCore, AUavThatIsHeldRecoversAlthoughItsGoalsAreReplaced) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    WantsOnePlaceAfterTheOther uav(seed);
    int told = 0;
    for (int i = 0; i < 2400; ++i) {
      PlannerInput in = uav.input();
      uav.core.update(in);
      in.flight = uav.core.state();
      for (const Outcome& outcome : in.flight.outcomes) told += outcome.reason == "held at one place";
      std::optional<std::vector<Goal>> goals;
      if (i % 30 == 0) {
        goals = {{.id = ++uav.id, .way = {{Vector3d(60.0, uav.random.uniform(-10.0, 10.0), 10.0), 3.0}}}};
      }
      uav.fly_by(uav.core.step(in, std::move(goals)));
      uav.note_doing(in);
    }
    EXPECT_TRUE(uav.seen.contains(Doing::What::looks_round)) << "seed " << seed;
    const bool flies = uav.seen.contains(Doing::What::approaches) || uav.seen.contains(Doing::What::elsewhere);
    EXPECT_TRUE(flies) << "seed " << seed;
    EXPECT_GT(told, 0) << "seed " << seed;
  }
}

// The UAV must fly home, and structure that it saw later blocks the path. It recovers as it does for goals of its
// strategy, and gets home along its own trail.
TEST(FlightCore, RecoversWhereThereIsNoWayHome) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    WantsOnePlaceAfterTheOther uav(seed);
    uav.agent.station_position = {0.0, 0.0, 0.3};
    uav.lidar_works = false;
    uav.map = WorldMap(WorldMap::Config{});
    uav.clear({-6.0, -6.0, 4.0}, {36.0, 6.0, 16.0});
    uav.flying = true;
    const double far_m = uav.random.uniform(26.0, 30.0), wall_m = uav.random.uniform(14.0, 18.0);
    uav.exchange();
    uav.tracker.follow({{{Vector3d(far_m, 0.0, 10.0), 4.0}}});
    while (!uav.tracker.tracking().done) uav.exchange();
    // A hole of 2 m to each side is too little for kHaloM and the map's cubes.
    for (const double sign : {-1.0, 1.0}) {
      for (const int axis : {1, 2}) {
        Vector3d low(wall_m, -6.0, 4.0), high(wall_m + 1.0, 5.9, 15.9);
        const double middle_m = axis == 1 ? 0.0 : 10.0;
        (sign > 0 ? low : high)[axis] = middle_m + sign * 2.2;
        uav.build(low, high);
      }
    }
    uav.undelivered = 3;
    uav.remaining_s = 300.0;
    for (int i = 0; i < 100; ++i) uav.exchange();
    uav.seen.clear();
    uav.remaining_s = 1.0;
    for (int i = 0; i < 2400 && uav.state.p_WB.x() > wall_m - 3.0; ++i) uav.exchange();
    EXPECT_LT(uav.state.p_WB.x(), wall_m - 2.9) << "seed " << seed;
    EXPECT_TRUE(uav.seen.contains(Doing::What::back)) << "seed " << seed;
  }
}

// After an interruption, the UAV flies no leg of its line again but the interrupted one. It counts legs as its strategy
// does.
TEST(FlightCore, AUavContinuesALineThatWasInterrupted) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "line", 0);
    AgentConfig agent = a_lone_explorer();
    agent.fleet.push_back(
        {.name = "b", .role = Role::photographer, .p_WB_start = {0.0, 16.0, 0.0}, .body_radius_m = 0.32});
    CoreUav uav(agent, {-20.0, -20.0, 10.0});
    uav.clear({-24.0, -24.0, 2.0}, {24.0, 24.0, 24.0});
    uav.boxes = {make_box({60.0, 0.0, 9.0}, {6.0, 6.0, 8.0})};
    std::vector<Waypoint> way;
    const double speed_mps = random.uniform(0.8, 1.2);
    for (int i = 0; i <= 10; ++i) way.push_back({{i % 2 == 0 ? -20.0 : 20.0, -20.0 + 3.0 * i, 10.0}, speed_mps});
    std::size_t leg = 0;
    int shows = 0, begun_late = 0;
    bool showed = false, reached = false;
    for (int i = 0; i < 20 * 2000 && !reached; ++i) {
      PlannerInput in = uav.input();
      uav.core.update(in);
      in.flight = uav.core.state();
      for (const Outcome& outcome : in.flight.outcomes) reached |= outcome.id == 1;
      if (in.flight.on_way) {
        EXPECT_GE(in.flight.leg + 1, leg) << "seed " << seed << ", after " << i << " exchanges";
        leg = std::max(leg, in.flight.leg);
      }
      std::optional<std::vector<Goal>> goals;
      if (i == 30) goals = {{.id = 1, .way = way}};
      uav.fly_by(uav.core.step(in, std::move(goals)));
      const bool now = uav.core.doing(in).what == Doing::What::shows_mate;
      if (now && !showed) ++shows;
      if (now && !showed && leg >= 2) ++begun_late;
      showed = now;
    }
    EXPECT_TRUE(reached) << "seed " << seed;
    EXPECT_GE(leg, way.size() - 1) << "seed " << seed;
    EXPECT_GE(begun_late, 1) << "seed " << seed << ", " << shows << " shows";
  }
}

// No explorer saw the photographer rise, so it assumed that space outside the boxes is free. The map that it receives
// then is of a place far away.
TEST(FlightCore, APhotographerThatAssumedSpaceToBeFreeFliesToTheSpaceThatItIsTold) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "told", 0);
    AgentConfig agent;
    agent.self = UavIndex(1);
    agent.fleet = {{.name = "a", .p_WB_start = {0.0, 80.0, 0.0}},
                   {.name = "b", .role = Role::photographer, .body_radius_m = 0.32}};
    CoreUav uav(agent, {0.0, 0.0, 4.0});
    uav.lidar_works = false;
    uav.map.set_free(uav.state.p_WB, 1.2);
    uav.boxes = {make_box({0.0, -60.0, 9.0}, {6.0, 6.0, 8.0})};
    const double turn = random.uniform(0.0, 6.28), off_m = random.uniform(20.0, 45.0);
    const Vector3d told_W(off_m * std::cos(turn), off_m * std::sin(turn), random.uniform(10.0, 14.0));
    const auto fly = [&](double time_s) {
      for (int i = 0; i < time_s * 20.0 && (uav.state.p_WB - told_W).norm() > 0.5; ++i) {
        PlannerInput in = uav.input();
        uav.core.update(in);
        in.flight = uav.core.state();
        std::optional<std::vector<Goal>> goals;
        if (i % 30 == 0) goals = {{.id = static_cast<std::int64_t>(uav.k), .way = {{told_W, 3.0}}}};
        uav.fly_by(uav.core.step(in, std::move(goals)));
      }
    };
    fly(40.0);
    EXPECT_LT((uav.state.p_WB - Vector3d(0.0, 0.0, 4.0)).norm(), 1.3) << "seed " << seed << ": it has received no map";
    fly(5.0 + random.uniform(0.5, 3.0));
    ASSERT_GT((uav.state.p_WB - told_W).norm(), 15.0) << "seed " << seed;
    uav.clear(told_W - Vector3d::Constant(10.0), told_W + Vector3d::Constant(10.0));
    ASSERT_GT(uav.map.regions().size(), 8U);
    fly(120.0);
    EXPECT_LT((uav.state.p_WB - told_W).norm(), 0.6) << "seed " << seed << ": it is at " << uav.state.p_WB.transpose();
  }
}

// The explorer's strategy sets one line after another, without a break.
TEST(FlightCore, AnExplorerOnALineShowsAPhotographerItsWayAfterAWhile) {
  AgentConfig agent = a_lone_explorer();
  agent.fleet.push_back(
      {.name = "b", .role = Role::photographer, .p_WB_start = {0.0, 12.0, 0.0}, .body_radius_m = 0.32});
  CoreUav uav(agent, {0.0, 0.0, 10.0});
  uav.clear({-24.0, -24.0, 2.0}, {24.0, 24.0, 24.0});
  uav.boxes = {make_box({60.0, 0.0, 9.0}, {6.0, 6.0, 8.0})};
  int times = 0;
  bool shows = false;
  for (int i = 0; i < 1600; ++i) {
    PlannerInput in = uav.input();
    uav.core.update(in);
    in.flight = uav.core.state();
    const Vector3d here_W = in.tracking.setpoint.p_WB;
    std::optional<std::vector<Goal>> goals;
    if (i % 30 == 0) {
      goals = {
          {.id = i,
           .way = {{here_W, 2.0}, {here_W.y() > 0.0 ? Vector3d(0.0, -8.0, 10.0) : Vector3d(0.0, 8.0, 10.0), 2.0}}}};
    }
    uav.fly_by(uav.core.step(in, std::move(goals)));
    const bool showed = std::exchange(shows, uav.core.doing(in).what == Doing::What::shows_mate);
    if (shows && !showed) ++times;
  }
  EXPECT_GE(times, 2) << "the first time, the explorer has no line yet";
}

/// A photographer in a neck of a corridor that another UAV blocks. The photographer hovers nearer to that UAV than the
/// safety filter would have let it come, and the path search, whose start is not free, finds a path past it. The
/// strategy replaces the goal every 1.5 s by another place behind that UAV.
struct HeldInACorridor : CoreUav {
  explicit HeldInACorridor(std::uint64_t seed) : CoreUav(two_photographers(), {-20.0, 0.0, 10.0}) {
    lidar_works = false;
    boxes = {make_box({60.0, 0.0, 9.0}, {6.0, 6.0, 8.0})};
    clear({-24.0, -4.0, 6.0}, {24.0, 4.0, 14.0});
    RandomStream random(seed, "held", 0);
    other_W = Vector3d(random.uniform(1.1, 1.5), random.uniform(-0.3, 0.3), 10.0 + random.uniform(-0.3, 0.3));
    fly_to({0.0, 0.0, 10.0}, 400);
    EXPECT_LT(state.p_WB.norm(), 10.1) << "at its place";
    build({-5.0, 1.5, 6.0}, {1.2, 2.9, 13.9});  // a neck that was seen too late
    build({-5.0, -3.0, 6.0}, {1.2, -1.6, 13.9});
  }
  static AgentConfig two_photographers() {
    AgentConfig agent;
    agent.fleet = {{.name = "a", .role = Role::photographer, .body_radius_m = 0.32},
                   {.name = "b", .role = Role::photographer, .p_WB_start = {0.0, 60.0, 0.0}, .body_radius_m = 0.32}};
    return agent;
  }
  void fly_to(const Vector3d& p_W, int exchanges) {
    for (int i = 0; i < exchanges; ++i) {
      PlannerInput in = input();
      core.update(in);
      in.flight = core.state();
      fly_by(core.step(in, std::vector<Goal>{{.id = id, .way = {{p_W, 3.0}}}}));
    }
  }
  void see_the_other() {
    peers.update(input().tick, {{node_of_uav(UavIndex(1)), other_W, Vector3d(Vector3d::Zero())}});
  }
  Vector3d other_W;
  std::int64_t id = 0;
};

TEST(FlightCore, AUavThatIsHeldByAnotherOneFliesAway) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    HeldInACorridor uav(seed);
    RandomStream random(seed, "goals", 0);
    double away_m = 0.0, least_m = 10.0;
    for (int decisions = 0; decisions < 40; ++decisions) {
      const Vector3d behind_W(random.uniform(8.0, 18.0), random.uniform(-0.8, 0.8), random.uniform(9.5, 10.5));
      ++uav.id;
      for (int i = 0; i < 30; ++i) {
        uav.see_the_other();
        uav.fly_to(behind_W, 1);
        away_m = std::max(away_m, (uav.state.p_WB - uav.other_W).norm());
        least_m = std::min(least_m, (uav.state.p_WB - uav.other_W).norm());
      }
    }
    EXPECT_GT(away_m, 5.0) << "seed " << seed;
    EXPECT_GT(least_m, 2 * 0.32) << "seed " << seed;
  }
}

// The strategy sets its goal only once, while the UAV flies aside.
TEST(FlightCore, AUavThatHasMadeRoomFliesToItsGoal) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "room", 0);
    CoreUav uav(HeldInACorridor::two_photographers(), {0.0, 0.0, 10.0});
    uav.lidar_works = false;
    uav.boxes = {make_box({60.0, 0.0, 9.0}, {6.0, 6.0, 8.0})};
    uav.clear({-24.0, -24.0, 2.0}, {24.0, 24.0, 24.0});
    const double angle = random.uniform(0.0, 6.28), off_m = random.uniform(1.1, 1.5);
    const Vector3d other_W(off_m * std::cos(angle), off_m * std::sin(angle), 10.0);
    bool asked = false, reached = false;
    for (int i = 0; i < 1200; ++i) {
      uav.peers.update(uav.input().tick, {{node_of_uav(UavIndex(1)), other_W, Vector3d(Vector3d::Zero())}});
      PlannerInput in = uav.input();
      uav.core.update(in);
      in.flight = uav.core.state();
      for (const Outcome& outcome : in.flight.outcomes) {
        reached |= outcome.id == 1 && outcome.kind == Outcome::Kind::reached;
      }
      std::optional<std::vector<Goal>> goals;
      if (!asked && i % 30 == 0) goals = {{.id = 100 + i, .way = {{in.tracking.setpoint.p_WB, 3.0}}}};  // it rests
      if (!asked && uav.core.doing(in).what == Doing::What::makes_room) {
        goals = {{.id = 1, .way = {{Vector3d(-10.0, random.uniform(-5.0, 5.0), 12.0), 3.0}}}};
        asked = true;
      }
      uav.fly_by(uav.core.step(in, std::move(goals)));
    }
    EXPECT_TRUE(asked) << "seed " << seed;
    EXPECT_TRUE(reached) << "seed " << seed;
  }
}

// The UAV lands because its battery is low, and gets a full battery on the ground. Meanwhile, the strategy has set its
// goal.
TEST(FlightCore, WithAFullBatteryAUavThatHasLandedFliesToItsGoal) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "full_battery", 0);
    AgentConfig agent = seed % 2 == 0 ? a_lone_explorer() : HeldInACorridor::two_photographers();
    agent.battery.endurance_missions = 0.5;
    CoreUav uav(agent, {random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), random.uniform(5.0, 15.0)});
    uav.boxes = {make_box({60.0, 0.0, 9.0}, {6.0, 6.0, 8.0})};
    uav.clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
    BatteryStatus battery{.charge = random.uniform(0.3, 0.5)};
    int landed = 0;
    const int swap = 20 + static_cast<int>(random.bits() % 200);
    bool asked = false, reached = false;
    for (int i = 0; i < 4000 && !reached; ++i) {
      battery.charge -= 0.0004;
      if (landed > swap) battery.charge = 1.0;
      PlannerInput in = uav.input();
      in.battery = battery;
      uav.core.update(in);
      in.flight = uav.core.state();
      for (const Outcome& outcome : in.flight.outcomes) {
        reached |= outcome.id == 1 && outcome.kind == Outcome::Kind::reached;
      }
      std::optional<std::vector<Goal>> goals;
      if (!asked && uav.core.doing(in).what == Doing::What::lands) {
        goals = {{.id = 1, .way = {{Vector3d(random.uniform(-10.0, 10.0), 9.0, random.uniform(6.0, 12.0)), 3.0}}}};
        asked = true;
      }
      uav.fly_by(uav.core.step(in, std::move(goals)));
      uav.state.p_WB.z() = std::max(uav.state.p_WB.z(), 0.1);
      landed = asked && uav.state.p_WB.z() < 0.11 ? landed + 1 : landed > swap ? landed : 0;
    }
    EXPECT_TRUE(asked) << "seed " << seed;
    EXPECT_GT(landed, swap) << "seed " << seed << ": it stands on the ground";
    EXPECT_TRUE(reached) << "seed " << seed;
    EXPECT_EQ(uav.core.filter().trust(), SafetyFilter::Trust::proved) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
