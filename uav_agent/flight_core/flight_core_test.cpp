// What a strategy hears of its goals, whatever comes between.
#include "uav_agent/flight_core/flight_core.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

AgentConfig a_lone_explorer() {
  AgentConfig agent;
  agent.fleet = {{.name = "a"}};
  return agent;
}

/// A strategy that wants one place after the other: most of them inside structure, or where nobody proves anything.
struct WantsOnePlaceAfterTheOther : FlownUav {
  explicit WantsOnePlaceAfterTheOther(std::uint64_t seed)
      : FlownUav(a_lone_explorer(), {0.0, 0.0, 10.0}), random(seed, "outcomes", 0) {
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
    if (steering.yaw) tracker.turn_to(*steering.yaw);
    if (const auto* path = std::get_if<Path>(&steering.motion)) tracker.follow(*path);
    if (std::holds_alternative<Hold>(steering.motion)) tracker.hold();
    core.move(tracker, {.tick = in.tick, .state = state, .map = map, .boxes = boxes, .peers = peers});
    state.p_WB = tracker.commanded().p_WB;
    state.v_WB = tracker.commanded().v_WB;
    ++k;
  }
  /// What it is about for people is what its strategy hears of it.
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
  FlightCore core{config, agent};
  std::int64_t id = 0;
  bool flying = false;
  int outcomes = 0, forgotten = 0, longest_forgotten = 0;
};

// The last goal's outcome may fall together with the begin of a recovery: above all when a program was stopped for some
// seconds, for then nothing has got on for long.
TEST(FlightCore, EachOutcomeIsHeardWhenTheStrategyDecides) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    WantsOnePlaceAfterTheOther uav(seed);
    for (int i = 0; i < 3000; ++i) {
      uav.exchange();
      if (uav.random.uniform() < 0.005) uav.k += 20 + uav.random.bits() % 300;  // it stands still for 1 to 16 s
    }
    EXPECT_GT(uav.outcomes, 2) << "seed " << seed;
    EXPECT_LE(uav.longest_forgotten, 1) << "seed " << seed;
    EXPECT_EQ(uav.wrong, 0) << "seed " << seed;
    EXPECT_TRUE(uav.seen.contains(Doing::What::to_goal)) << "seed " << seed;
    EXPECT_TRUE(uav.recovers) << "seed " << seed;
  }
}

// It is due home, and structure that was seen since has closed the way: it does what it would do for its strategy, and
// gets home along its own trail.
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

}  // namespace
}  // namespace skein::agent
