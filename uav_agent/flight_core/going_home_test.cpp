// Flights home, with a whole flight core. The tests check when a UAV gives up such a flight, and that its strategy's
// goals stay in force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/core_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kRoomHalfM = 20.0;

/// A UAV without a working LiDAR in a block of space that is proved free, with captures that it must deliver. Without
/// further beams, it can never leave this space.
struct InARoom : CoreUav {
  explicit InARoom(const Vector3d& station_W) : CoreUav(with_station(station_W), {0.0, 0.0, 12.0}) {
    config.deliver_every_s = 30.0;
    lidar_works = false;
    clear({-kRoomHalfM, -kRoomHalfM, 4.0}, {kRoomHalfM, kRoomHalfM, 20.0});
    boxes = {make_box({300.0, 0.0, 9.0}, {6.0, 6.0, 8.0})};
    undelivered = 3;
    remaining_s = 1e4;
  }
  static AgentConfig with_station(const Vector3d& station_W) {
    AgentConfig agent;
    agent.fleet = {{.name = "a"}};
    agent.station_position = station_W;
    return agent;
  }
  /// One exchange.   @param goals  what the strategy returns.   @returns the outcomes that it receives.
  std::vector<Outcome> exchange(std::optional<std::vector<Goal>> goals = std::nullopt) {
    PlannerInput in = input();
    core.update(in);
    in.flight = core.state();
    std::vector<Outcome> outcomes = in.flight.outcomes;
    const Steering steering = core.step(in, std::move(goals), stake);
    doing = core.doing(in).what;
    fly_by(steering);
    return outcomes;
  }
  double now_s() const { return static_cast<double>(k) * agent.exchange_period_s; }
  bool goes_home() const {
    using enum Doing::What;
    return doing == homing || doing == awaits_link;
  }
  bool recovers() const {
    using enum Doing::What;
    return doing == looks_round || doing == approaches || doing == elsewhere || doing == climbs || doing == back;
  }
  std::optional<Stake> stake;
  Doing::What doing = Doing::What::ground;
};

// No beam proves the space between the UAV's room and the station.
TEST(GoingHome, AUavThatFindsNoPathHomeGoesBackToWork) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "no_way_home", 0);
    const double turn = random.uniform(0.0, 6.28), off_m = random.uniform(60.0, 200.0);
    InARoom uav({off_m * std::cos(turn), off_m * std::sin(turn), 0.3});
    std::int64_t id = 0;
    int reached_late = 0, recoveries = 0;
    bool asks = true, recovered = false;
    while (uav.now_s() < 600.0) {
      std::optional<std::vector<Goal>> goals;
      if (asks) {
        const Vector3d place_W(random.uniform(-12.0, 12.0), random.uniform(-12.0, 12.0), random.uniform(7.0, 17.0));
        goals = {{.id = ++id, .way = {{place_W, 3.0}}}};
      }
      const auto outcomes = uav.exchange(std::move(goals));
      asks = std::ranges::any_of(outcomes, [&](const Outcome& outcome) { return outcome.id == id; });
      const bool reached = asks && outcomes.back().kind == Outcome::Kind::reached;
      if (reached && uav.now_s() > 120.0) ++reached_late;
      if (uav.recovers() && !std::exchange(recovered, uav.recovers())) ++recoveries;
      recovered = uav.recovers();
    }
    EXPECT_GT(reached_late, 10) << "seed " << seed;
    EXPECT_GE(recoveries, 3) << "seed " << seed << ": it must try to fly home again and again";
  }
}

// The strategy's goal lasts for the whole test.
TEST(GoingHome, WithAStakeAUavGoesHomeWhenTheDeliveryPays) {
  for (const double value : {0.0, 1.0, 1000.0}) {
    InARoom uav({0.0, -14.0, 4.5});
    uav.config.hazard_per_h = 2.0;
    uav.stake = Stake{.value = value, .gain_per_s = 1.0};
    uav.exchange(std::vector<Goal>{{.id = 1, .way = {{Vector3d(0.0, 12.0, 12.0), 1.0}}}});
    double home_s = 0.0;
    while (uav.now_s() < 200.0 && home_s == 0.0) {
      uav.exchange();
      if (uav.goes_home()) home_s = uav.now_s();
    }
    if (value < 1000.0) {
      EXPECT_EQ(home_s, 0.0) << "value " << value << ": deliver_every_s is over, but the flight costs more";
    } else {
      EXPECT_GT(home_s, 0.0);
    }
  }
}

// With 10 s left in the mission, the UAV keeps searching for a path home instead of flying to further goals.
TEST(GoingHome, NearTheEndOfTheMissionAUavThatFindsNoPathHomeDoesNotGiveUp) {
  InARoom uav({150.0, 0.0, 0.3});
  int worked = 0;
  for (int i = 0; i < 20 * 300; ++i) {
    std::optional<std::vector<Goal>> goals;
    if (i % 30 == 0) goals = {{.id = i, .way = {{Vector3d(0.0, 10.0, 10.0), 3.0}}}};
    if (i > 20 * 40) uav.remaining_s = 10.0;
    uav.exchange(std::move(goals));
    if (i > 20 * 120 && uav.doing == Doing::What::to_goal) ++worked;
  }
  EXPECT_EQ(worked, 0);
}

// The strategy sets the goal only once, and the UAV has not reached it when it must fly home. The link returns while
// the UAV flies home, or while it recovers because it finds no path home.
TEST(GoingHome, TheUavFliesToItsFormerGoalWhenALinkEndsItsFlightHome) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "outlives", 0);
    const bool has_way = seed % 2 == 0;
    InARoom uav(has_way ? Vector3d(random.uniform(-8.0, 8.0), -14.0, 4.5) : Vector3d(150.0, 0.0, 0.3));
    const Vector3d place_W(random.uniform(-12.0, 12.0), 12.0, random.uniform(7.0, 17.0));
    const double link_after_s = random.uniform(0.1, 2.0);
    double due_s = 0.0;
    bool reached = false;
    while (uav.now_s() < 30.0) uav.exchange();
    uav.exchange(std::vector<Goal>{{.id = 1, .way = {{place_W, 1.0}}}});
    while (uav.now_s() < 120.0 && !reached) {
      for (const Outcome& outcome : uav.exchange()) {
        EXPECT_EQ(outcome.id, 1) << "seed " << seed;
        reached |= outcome.kind == Outcome::Kind::reached;
      }
      EXPECT_FALSE(reached && due_s == 0.0) << "seed " << seed << ": it reached the goal before it had to fly home";
      if (due_s == 0.0 && (has_way ? uav.goes_home() : uav.recovers())) due_s = uav.now_s();
      uav.linked = due_s > 0.0 && uav.now_s() > due_s + link_after_s;
      if (uav.linked) uav.undelivered = 0;
    }
    EXPECT_GT(due_s, 0.0) << "seed " << seed;
    EXPECT_TRUE(reached) << "seed " << seed << ": it is at " << uav.state.p_WB.transpose();
  }
}

}  // namespace
}  // namespace skein::agent
