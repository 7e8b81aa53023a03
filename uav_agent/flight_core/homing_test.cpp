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
      homing.update(input());
    }
  }
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
