// Takeoffs: the order in which UAVs lift off, the climb, and what a UAV does that is held while it climbs.
#include "uav_agent/flight_core/takeoff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kStandsM = 0.16;  ///< height of a UAV's centre on the ground

/// UAVs that stand 3 m apart, the first ones explorers.
AgentConfig standing_fleet(std::size_t explorers, std::size_t photographers, std::size_t self) {
  AgentConfig agent;
  for (std::size_t i = 0; i < explorers + photographers; ++i) {
    const Vector3d start_W(3.0 * static_cast<double>(i), 0.0, kStandsM);
    agent.fleet.push_back({.name = "uav" + std::to_string(i),
                           .role = i < explorers ? Role::explorer : Role::photographer,
                           .p_WB_start = start_W});
  }
  agent.self = UavIndex(self);
  return agent;
}

struct StandingUav : FlownUav {
  explicit StandingUav(const AgentConfig& agent) : FlownUav(agent, agent.me().p_WB_start) {
    boxes = {make_box({60.0, 60.0, 10.0}, {20.0, 20.0, 20.0})};
  }
  /// Runs exchanges until the takeoff reaches a phase. @returns the time that it took [s]; nullopt after most_s.
  std::optional<double> takes_until(Takeoff::Phase phase, double most_s) {
    const std::uint64_t began = k;
    while (static_cast<double>(k - began) * agent.exchange_period_s < most_s) {
      if (beside_W) peers.update(input().tick, {{node_of_uav(UavIndex(1)), *beside_W, Vector3d(Vector3d::Zero())}});
      PlannerInput in = input();
      in.uncertainty = uncertainty;
      navigator.update(in);
      Steering steering;
      const Takeoff::Phase now = takeoff.step(in, steering);
      fly(steering);
      farthest_m = std::max(farthest_m, (state.p_WB - agent.me().p_WB_start).head<2>().norm());
      if (takeoff.waits_for()) waited_for.insert(*takeoff.waits_for());
      if (now == phase) return static_cast<double>(k - began) * agent.exchange_period_s;
    }
    return std::nullopt;
  }

  Landing landing{config, agent, filter, navigator};
  Takeoff takeoff{config, agent, filter, navigator, landing};
  PoseUncertainty uncertainty;
  std::optional<Vector3d> beside_W;  ///< where UAV 1 is seen to stand; nullopt: it is not seen
  std::set<std::size_t> waited_for;
  double farthest_m = 0.0;  ///< from the start, horizontally
};

TEST(Takeoff, UavsThatStandNearByClimbToHeightsOfTheirOwn) {
  std::set<double> heights_m;
  for (std::size_t self = 0; self < 3; ++self) {
    StandingUav uav(standing_fleet(3, 0, self));
    uav.clear({-10.0, -10.0, 0.0}, {20.0, 10.0, 20.0});
    ASSERT_TRUE(uav.takes_until(Takeoff::Phase::over, 60.0)) << self;
    EXPECT_NEAR(uav.state.p_WB.z(), uav.takeoff.top_W()->z(), 0.1) << self;
    heights_m.insert(std::round(uav.state.p_WB.z()));
  }
  EXPECT_EQ(heights_m.size(), 3U);
}

TEST(Takeoff, ExplorersLiftOffFirstAndABrokenUavIsNotAwaitedForEver) {
  StandingUav first(standing_fleet(1, 2, 0)), last(standing_fleet(1, 2, 2));
  for (StandingUav* uav : {&first, &last}) uav->clear({-10.0, -10.0, 0.0}, {20.0, 10.0, 20.0});
  const auto first_s = first.takes_until(Takeoff::Phase::climbs, 60.0);
  EXPECT_TRUE(first_s && *first_s < 1.0);
  EXPECT_TRUE(first.waited_for.empty());
  const auto last_s = last.takes_until(Takeoff::Phase::climbs, 60.0);  // the others stay at their starts
  EXPECT_TRUE(last_s && *last_s > 6.0 && *last_s < 20.0) << last_s.value_or(NAN);
  EXPECT_EQ(last.waited_for, (std::set<std::size_t>{1})) << "the last one before it that still stands";
}

TEST(Takeoff, AnExplorerThatDriftsSinksBackAndClimbsOnceSpaceIsProved) {
  StandingUav uav(standing_fleet(1, 0, 0));
  uav.uncertainty.position_m = {0.3, 0.3, 0.3};
  ASSERT_TRUE(uav.takes_until(Takeoff::Phase::climbs, 30.0));
  const auto given_up_s = uav.takes_until(Takeoff::Phase::ground, 60.0);
  ASSERT_TRUE(given_up_s);
  EXPECT_GE(*given_up_s, uav.config.stall_s + uav.config.look_s);
  EXPECT_LT(uav.state.p_WB.z(), kStandsM + 3.0);
  uav.takes_until(Takeoff::Phase::over, 10.0);
  EXPECT_LE(uav.tracker.tracking().setpoint.p_WB.z(), kStandsM) << "it does not hover, where it would drift";
  uav.clear({-10.0, -10.0, 0.0}, {10.0, 10.0, 20.0});
  EXPECT_TRUE(uav.takes_until(Takeoff::Phase::over, 60.0));
  EXPECT_GT(uav.state.p_WB.z(), kStandsM + 3.0);
}

// The UAV that stands below had moved aside from its start before, and landed there.
TEST(Takeoff, AUavSinksBackCloseAboveOneThatStandsAsideOfItsStart) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, "sinks_back", 0);
    StandingUav uav(standing_fleet(2, 0, 0));
    uav.clear({-20.0, -20.0, 0.0}, {20.0, 20.0, 4.0});
    uav.build({-20.0, -20.0, 3.0}, {19.9, 19.9, 3.4});  // a canopy
    const double off_m = random.uniform(1.35, 1.9), turn = random.uniform(-0.5, 0.5);
    uav.beside_W = Vector3d(off_m * std::cos(turn), off_m * std::sin(turn), kStandsM);
    ASSERT_GT((*uav.beside_W - uav.agent.fleet[1].p_WB_start).norm(), 1.0);
    ASSERT_TRUE(uav.takes_until(Takeoff::Phase::climbs, 30.0)) << "seed " << seed;
    ASSERT_TRUE(uav.takes_until(Takeoff::Phase::ground, 60.0)) << "seed " << seed;
    const double height_m = uav.state.p_WB.z();
    ASSERT_GT(height_m, 0.8) << "seed " << seed;
    uav.takes_until(Takeoff::Phase::over, 7.0);
    EXPECT_LE(uav.tracker.tracking().setpoint.p_WB.z(), kStandsM) << "seed " << seed << ", from " << height_m << " m";
    EXPECT_LT(uav.farthest_m, 0.05) << "seed " << seed << ": it comes no nearer to the other one's side";
  }
}

TEST(Takeoff, AUavWithoutDriftHoldsInItsClimbUntilSpaceIsProved) {
  StandingUav uav(standing_fleet(1, 0, 0));
  ASSERT_TRUE(uav.takes_until(Takeoff::Phase::climbs, 30.0));
  EXPECT_FALSE(uav.takes_until(Takeoff::Phase::ground, 60.0));
  EXPECT_EQ(uav.farthest_m, 0.0);
}

TEST(Takeoff, APhotographerThatCannotClimbWaitsForAnExplorer) {
  StandingUav uav(standing_fleet(1, 1, 1));
  ASSERT_FALSE(uav.takes_until(Takeoff::Phase::over, 40.0));
  EXPECT_TRUE(uav.waited_for.contains(0));
  uav.clear({-10.0, -10.0, 0.0}, {20.0, 10.0, 20.0});
  EXPECT_TRUE(uav.takes_until(Takeoff::Phase::over, 40.0));
}

TEST(Takeoff, IsOverForAUavThatIsRestartedInFlight) {
  AgentConfig agent = standing_fleet(1, 0, 0);
  agent.fleet[0].p_WB_start.z() = 7.0;
  StandingUav uav(agent);
  EXPECT_TRUE(uav.takes_until(Takeoff::Phase::over, 1.0));
  EXPECT_FALSE(uav.takeoff.top_W());
}

}  // namespace
}  // namespace skein::agent
