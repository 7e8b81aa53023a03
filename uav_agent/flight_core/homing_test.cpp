// Tests when a UAV has to fly home, and to which places.
#include "uav_agent/flight_core/homing.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

AgentConfig near_station(std::size_t self) {
  AgentConfig agent;
  agent.fleet = {{.name = "a"}, {.name = "b", .p_WB_start = {3.0, 0.0, 0.0}}};
  agent.self = UavIndex(self);
  agent.station_position = {0.0, 0.0, 0.3};
  return agent;
}

struct ComingHome : FlownUav {
  explicit ComingHome(const Vector3d& at_W, std::size_t self = 0) : FlownUav(near_station(self), at_W) {
    remaining_s = 1e4;
    homing.update(input());
  }
  void wait(double s) {
    for (int i = 0; i < static_cast<int>(s / agent.exchange_period_s); ++i) {
      ++k;
      homing.update(input(), stake);
    }
  }
  /// How long the UAV works on with the stake, until a delivery is due; `most_s` if it is not due earlier.
  double works_on_s(double most_s = 2000.0) {
    double worked_s = 0.0;
    while (worked_s < most_s && !homing.due(input())) {
      wait(1.0);
      worked_s += 1.0;
    }
    return worked_s;
  }
  std::optional<Stake> stake;
  Homing homing{config, agent};
};

TEST(Homing, IsDueWhenCapturesHaveWaitedForLong) {
  ComingHome uav({40.0, 0.0, 10.0});
  uav.wait(2.0 * uav.config.deliver_every_s);
  EXPECT_FALSE(uav.homing.due(uav.input())) << "there is nothing to deliver";
  uav.undelivered = 3;
  uav.wait(uav.config.deliver_every_s - 1.0);
  EXPECT_FALSE(uav.homing.due(uav.input()));
  uav.wait(2.0);
  EXPECT_TRUE(uav.homing.due(uav.input()));
}

TEST(Homing, AFlightHomeThatWasGivenUpIsDueAgainLaterAndAtTheEnd) {
  ComingHome uav({40.0, 0.0, 10.0});
  uav.undelivered = 3;
  uav.wait(uav.config.deliver_every_s + 1.0);
  ASSERT_TRUE(uav.homing.due(uav.input()));
  uav.homing.give_up(uav.input());
  EXPECT_FALSE(uav.homing.due(uav.input()));
  uav.remaining_s = 20.0;
  EXPECT_TRUE(uav.homing.due(uav.input())) << "it is the last chance";
  uav.remaining_s = 1e4;
  uav.wait(uav.config.deliver_every_s + 1.0);
  EXPECT_TRUE(uav.homing.due(uav.input()));
}

struct AtStake : ComingHome {
  AtStake(double off_m, const Stake& at_stake, double hazard_per_h) : ComingHome({off_m, 0.0, 10.0}) {
    stake = at_stake;
    config.hazard_per_h = hazard_per_h;
    undelivered = 3;
    wait(0.1);
  }
};

TEST(Homing, WithAStakeTheRuleByValueReplacesTheRuleByTime) {
  AtStake nothing(40.0, {.value = 0.0, .gain_per_s = 1.0}, 1.0);
  EXPECT_EQ(nothing.works_on_s(), 2000.0) << "far longer than deliver_every_s";
  AtStake idle(40.0, {.value = 0.1, .gain_per_s = 0.0}, 1.0);
  EXPECT_LE(idle.works_on_s(), 1.0);
  AtStake safe(40.0, {.value = 1000.0, .gain_per_s = 1.0}, 0.0);
  EXPECT_EQ(safe.works_on_s(), 2000.0) << "without a hazard, only the end of the mission counts";
  safe.remaining_s = 20.0;
  EXPECT_TRUE(safe.homing.due(safe.input()));
  AtStake in_danger(40.0, {.value = 0.1, .gain_per_s = 5.0}, 1e9);
  EXPECT_LE(in_danger.works_on_s(), 1.0);
  in_danger.stake.reset();
  in_danger.wait(1.0);
  EXPECT_FALSE(in_danger.homing.due(in_danger.input())) << "the planner states no stake any more";
}

TEST(Homing, AUavWithMoreAtStakeDeliversEarlier) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "at_stake", 0);
    const double off_m = random.uniform(20.0, 150.0), hazard_per_h = random.uniform(0.5, 6.0);
    const Stake before{random.uniform(20.0, 200.0), random.uniform(0.5, 3.0)};
    const auto worked_s = [](double at_m, const Stake& stake, double hazard) {
      return AtStake(at_m, stake, hazard).works_on_s();
    };
    const double usual_s = worked_s(off_m, before, hazard_per_h);
    EXPECT_LE(worked_s(off_m, {1.5 * before.value, before.gain_per_s}, hazard_per_h), usual_s);
    EXPECT_LE(worked_s(off_m, before, 1.5 * hazard_per_h), usual_s);
    EXPECT_GE(worked_s(off_m, {before.value, 1.5 * before.gain_per_s}, hazard_per_h), usual_s);
    EXPECT_GE(worked_s(off_m + 30.0, before, hazard_per_h), usual_s);
  }
}

// The last delivery is soon, so little is lost until then.
TEST(Homing, ShortlyBeforeTheLastDeliveryNoOtherOnePays) {
  AtStake uav(40.0, {.value = 50.0, .gain_per_s = 1.0}, 20.0), late(40.0, *uav.stake, 20.0);
  late.remaining_s = 100.0;
  EXPECT_LT(uav.works_on_s(), 2000.0);
  EXPECT_EQ(late.works_on_s(), 2000.0) << "remaining_s does not run down in this test";
}

TEST(Homing, AUavThatDeliversFromItsPlaceNeedNotLeaveForItsStake) {
  AtStake uav(40.0, {.value = 500.0, .gain_per_s = 0.0}, 10.0);
  uav.linked = true;
  for (uav.undelivered = 40; uav.undelivered > 0; --uav.undelivered) {
    uav.wait(2.0);
    EXPECT_FALSE(uav.homing.due(uav.input()));
  }
}

TEST(Homing, AFlightForAStakeThatWasGivenUpIsNotDueAgainAtOnce) {
  AtStake uav(40.0, {.value = 500.0, .gain_per_s = 0.0}, 10.0);
  ASSERT_LE(uav.works_on_s(), 1.0);
  uav.homing.give_up(uav.input());
  EXPECT_NEAR(uav.works_on_s(), uav.config.deliver_every_s, 1.0);
}

// On its way, the UAV had links at two places. By time, it returns to the later one, by value to the nearer one, and
// the nearer one makes a delivery pay earlier.
TEST(Homing, ByValueAUavFliesToTheNearestPlaceWithALink) {
  for (const bool by_value : {false, true}) {
    ComingHome uav({60.0, 0.0, 10.0});
    if (by_value) uav.stake = Stake{.value = 100.0, .gain_per_s = 1.0};
    const auto be_at = [&](const Vector3d& p_W, bool linked) {
      uav.state.p_WB = p_W;
      uav.tracker = Tracker(Tracker::Config{});
      uav.tracker.follow({{{p_W, 1.0}}});
      for (int i = 0; i < 20; ++i) uav.tracker.step(uav.state, uav.agent.exchange_period_s);
      uav.linked = linked;
      uav.wait(3.0);
    };
    const Vector3d near_W(100.0, 0.0, 10.0), far_W(20.0, 80.0, 10.0);
    be_at(near_W, true);
    be_at({60.0, 40.0, 10.0}, false);
    be_at(far_W, true);
    be_at({110.0, 0.0, 10.0}, false);
    const auto places_W = uav.homing.places(uav.input(), uav.navigator.space(uav.input()));
    EXPECT_LT((places_W.front() - (by_value ? near_W : far_W)).norm(), 0.5);
    if (!by_value) continue;
    uav.undelivered = 5;
    uav.config.hazard_per_h = 3600.0 * 16.0 / (100.0 * 100.0);  // due after 100 s of waiting for a detour of 16 s ...
    EXPECT_NEAR(uav.works_on_s(), 2.0 * (1.5 * 10.0 / uav.config.approach_mps + 6.0) / 16.0 * 100.0, 3.0);
  }
}

// The farther off a UAV is, the earlier it must leave. It never counts on flying faster than approach_mps.
TEST(Homing, IsDueInTimeForTheFlightHome) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    RandomStream random(seed, "way_home", 0);
    const double off_m = random.uniform(5.0, 200.0);
    ComingHome uav({off_m, 0.0, random.uniform(5.0, 30.0)});
    uav.undelivered = random.bits() % 5;
    uav.homing.update(uav.input());
    uav.remaining_s = off_m / uav.config.approach_mps + uav.config.return_margin_s - 0.1;
    EXPECT_TRUE(uav.homing.due(uav.input())) << off_m;
    uav.remaining_s = 10.0 * off_m / uav.config.approach_mps + uav.config.return_margin_s + 100.0;
    EXPECT_FALSE(uav.homing.due(uav.input())) << off_m;
  }
}

TEST(Homing, AUavThatDeliversFromItsPlaceNeedNotLeave) {
  ComingHome uav({40.0, 0.0, 10.0});
  uav.linked = true;
  uav.undelivered = 10;
  uav.homing.update(uav.input());
  uav.remaining_s = 1.0;
  for (; uav.undelivered > 0; --uav.undelivered) {
    uav.wait(2.0);
    EXPECT_TRUE(uav.homing.delivers_here(uav.input()));
    EXPECT_FALSE(uav.homing.due(uav.input()));
  }
  uav.undelivered = 4;
  uav.wait(10.0);
  EXPECT_FALSE(uav.homing.delivers_here(uav.input())) << "nothing arrives any more";
  EXPECT_TRUE(uav.homing.due(uav.input()));
}

TEST(Homing, IsDoneOnceAllIsDeliveredAndTimeIsLeft) {
  ComingHome uav({20.0, 0.0, 10.0});
  uav.undelivered = 2;
  uav.linked = true;
  uav.wait(1.0);
  EXPECT_FALSE(uav.homing.done(uav.input()));
  uav.undelivered = 0;
  uav.wait(1.0);
  EXPECT_TRUE(uav.homing.done(uav.input()));
  uav.remaining_s = uav.config.return_margin_s;
  EXPECT_FALSE(uav.homing.done(uav.input())) << "it would be due again at once";
}

// The first place is one where the link lasted, not where it broke. The last place is always above the station.
TEST(Homing, GoesBackToWhereItHadTheLink) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "linked", 0);
    ComingHome uav({10.0, 0.0, 10.0});
    uav.clear({-10.0, -10.0, 0.0}, {60.0, 10.0, 30.0});
    uav.navigator.want({{.id = 1, .way = {{{50.0, 0.0, 10.0}, 4.0}}}});
    const double ends_m = random.uniform(20.0, 40.0);
    std::vector<Vector3d> linked_W;
    while (uav.state.p_WB.x() < 48.0) {
      uav.linked = uav.state.p_WB.x() < ends_m;
      if (uav.linked) linked_W.push_back(uav.state.p_WB);
      uav.homing.update(uav.input());
      uav.navigate();
      ASSERT_LT(uav.k, 2000U);
    }
    const auto places_W = uav.homing.places(uav.input(), uav.navigator.space(uav.input()));
    ASSERT_GE(places_W.size(), 2U);
    EXPECT_LT(places_W.front().x(), ends_m - 0.5) << "some way before it broke";
    EXPECT_GT(places_W.front().x(), ends_m - 15.0);
    EXPECT_LT((places_W.back() - uav.agent.station_position).head<2>().norm(), 0.1);
  }
}

TEST(Homing, TwoUavsThatFlyHomeGetDifferentPlacesAboveTheStation) {
  ComingHome first({40.0, 0.0, 10.0}, 0), second({40.0, 5.0, 10.0}, 1);
  const auto one = first.homing.places(first.input(), first.navigator.space(first.input()));
  const auto other = second.homing.places(second.input(), second.navigator.space(second.input()));
  EXPECT_GT((one.back() - other.back()).norm(), 2.0 * 0.63 + first.config.peer_margin_m);
}

}  // namespace
}  // namespace skein::agent
