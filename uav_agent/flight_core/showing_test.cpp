// Tests which explorer shows which photographer its way up, from where, and how often.
#include "uav_agent/flight_core/showing.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

AgentConfig drawn_fleet(RandomStream& random, std::size_t uavs) {
  AgentConfig agent;
  for (std::size_t i = 0; i < uavs; ++i) {
    const bool explorer = i == 0 || random.uniform() < 0.5;
    agent.fleet.push_back({.name = "uav" + std::to_string(i),
                           .role = explorer ? Role::explorer : Role::photographer,
                           .p_WB_start = {random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0), 0.0},
                           .body_radius_m = explorer ? 0.63 : 0.32});
  }
  return agent;
}

struct Shows : FlownUav {
  Shows(AgentConfig of_agent, std::size_t self) : FlownUav(as(std::move(of_agent), self), Vector3d(0.0, 0.0, 12.0)) {}
  static AgentConfig as(AgentConfig of_agent, std::size_t self) {
    of_agent.self = UavIndex(self);
    return of_agent;
  }
  std::optional<Goal> next() { return showing.next(input(), navigator.space(input())); }
  double to_start_m(std::size_t uav) const { return (agent.fleet[uav].p_WB_start - agent.me().p_WB_start).norm(); }
  Showing showing{agent, filter};
};

// The explorer that starts nearest, and no other, shows each photographer its way, at growing intervals.
TEST(Showing, EachPhotographerIsShownItsWayByTheNearestExplorer) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "fleet", 0);
    const AgentConfig fleet = drawn_fleet(random, 2 + random.bits() % 6);
    std::map<std::size_t, std::size_t> shown_by;
    for (std::size_t self = 0; self < fleet.fleet.size(); ++self) {
      Shows uav(fleet, self);
      std::map<std::size_t, int> attempts;
      for (int i = 0; i < 400; ++i, uav.k += 40) {  // 800 s
        const auto goal = uav.next();
        if (!goal) continue;
        const std::size_t mate = uav.showing.mate();
        ++attempts[mate];
        ASSERT_EQ(uav.agent.me().role, Role::explorer);
        ASSERT_EQ(fleet.fleet[mate].role, Role::photographer);
        ASSERT_TRUE(!shown_by.contains(mate) || shown_by[mate] == self) << "two show uav" << mate;
        shown_by[mate] = self;
        EXPECT_TRUE(uav.navigator.space(uav.input()).free(goal->way.front().p_WB));
        EXPECT_GT((goal->way.front().p_WB - fleet.fleet[mate].p_WB_start).head<2>().norm(), 2.0) << "not above it";
        for (std::size_t other = 0; other < fleet.fleet.size(); ++other) {
          if (fleet.fleet[other].role != Role::explorer) continue;
          EXPECT_LE(uav.to_start_m(mate), (fleet.fleet[other].p_WB_start - fleet.fleet[mate].p_WB_start).norm() + 1e-9);
        }
      }
      for (const auto& [mate, count] : attempts) EXPECT_LE(count, 10) << "uav" << mate;
    }
    for (std::size_t i = 0; i < fleet.fleet.size(); ++i) {
      EXPECT_EQ(shown_by.contains(i), fleet.fleet[i].role == Role::photographer) << "seed " << seed << " uav" << i;
    }
  }
}

/// An explorer takes over if those that start nearer may be lost. The more of them there are, the later it does so, and
/// only if it sees the photographer stand.
TEST(Showing, FartherExplorersTakeOverAPhotographerThatTheySeeStand) {
  AgentConfig fleet;
  fleet.fleet = {{.name = "near", .p_WB_start = {6.0, 1.0, 0.0}},
                 {.name = "far", .p_WB_start = {0.0, 0.0, 0.0}},
                 {.name = "farther", .p_WB_start = {-4.0, 0.0, 0.0}},
                 {.name = "p", .role = Role::photographer, .p_WB_start = {8.0, 0.0, 0.0}, .body_radius_m = 0.32}};
  const auto first_shown_s = [&](std::size_t self, double p_z_m, bool visible) -> std::optional<double> {
    Shows uav(fleet, self);
    for (int i = 0; i < 400; ++i, uav.k += 20) {  // 400 s
      const Vector3d p_W(8.0, 0.0, p_z_m);
      if (visible) uav.peers.update(uav.input().tick, {{node_of_uav(UavIndex(3)), p_W, std::nullopt}});
      if (uav.next()) return seconds(uav.input().tick);
    }
    return std::nullopt;
  };
  EXPECT_EQ(first_shown_s(0, 0.2, true), 0.0);
  EXPECT_EQ(first_shown_s(0, 0.2, false), 0.0);
  const auto second_s = first_shown_s(1, 0.2, true), third_s = first_shown_s(2, 0.2, true);
  ASSERT_TRUE(second_s && third_s);
  EXPECT_GE(*second_s, 60.0);
  EXPECT_LE(*second_s, 65.0);
  EXPECT_NEAR(*third_s, 2.0 * *second_s, 5.0);
  for (const std::size_t self : {1, 2}) {
    EXPECT_FALSE(first_shown_s(self, 0.2, false)) << "it may have risen, out of sight";
    EXPECT_FALSE(first_shown_s(self, 8.0, true)) << "it has risen";
  }
}

AgentConfig explorer_and_photographer() {
  AgentConfig agent;
  agent.fleet = {{.name = "a"},
                 {.name = "b", .role = Role::photographer, .p_WB_start = {6.0, 0.0, 0.0}, .body_radius_m = 0.32}};
  return agent;
}

TEST(Showing, EndsWhereTheColumnIsKnown) {
  Shows uav(explorer_and_photographer(), 0);
  ASSERT_TRUE(uav.next());
  EXPECT_FALSE(uav.showing.shown(uav.input()));
  uav.clear({2.0, -4.0, 0.0}, {10.0, 4.0, 3.0});
  EXPECT_FALSE(uav.showing.shown(uav.input())) << "only half of the column is known";
  uav.clear({2.0, -4.0, 0.0}, {10.0, 4.0, 10.0});
  EXPECT_TRUE(uav.showing.shown(uav.input()));
  uav.k += 400;
  EXPECT_FALSE(uav.next());
}

// The photographer may have received no map, because it is out of sight.
TEST(Showing, APhotographerThatStaysLowForLongIsShownAgain) {
  for (const bool seen : {false, true}) {
    Shows uav(explorer_and_photographer(), 0);
    uav.clear({-4.0, -10.0, 0.0}, {16.0, 10.0, 16.0});
    const auto see = [&](double z_m) {
      uav.peers.update(uav.input().tick, {{node_of_uav(UavIndex(1)), Vector3d(6.0, 0.0, z_m), std::nullopt}});
    };
    for (; uav.k < 1100; ++uav.k) {
      if (seen) see(0.2);
      ASSERT_FALSE(uav.next()) << uav.k;
    }
    uav.k += 200;
    ASSERT_TRUE(uav.next()) << "after a minute";
    EXPECT_FALSE(uav.showing.shown(uav.input())) << "it is still low";
    see(6.0);
    EXPECT_TRUE(uav.showing.shown(uav.input()));
    uav.k += 10000;
    EXPECT_FALSE(uav.next());
  }
}

// The photographer rose while the explorer was elsewhere.
TEST(Showing, APhotographerThatIsNotWhereItStoodIsForgotten) {
  for (const bool there : {true, false}) {
    Shows uav(explorer_and_photographer(), 0);
    uav.clear({-4.0, -10.0, 0.0}, {16.0, 10.0, 16.0});
    ASSERT_FALSE(uav.next());
    uav.k += 1300;
    const auto goal = uav.next();
    ASSERT_TRUE(goal) << "its column has been known for a minute";
    uav.tracker.follow({{{goal->way.front().p_WB, 4.0}}});
    for (int i = 0; i < 400 && !uav.tracker.tracking().done; ++i) {
      uav.tracker.step(uav.state, uav.agent.exchange_period_s);
      uav.state.p_WB = uav.tracker.commanded().p_WB;
    }
    int shows = 0;
    for (int i = 0; i < 100; ++i, uav.k += 400) {
      if (there) {
        uav.peers.update(uav.input().tick, {{node_of_uav(UavIndex(1)), Vector3d(6.0, 0.0, 0.2), std::nullopt}});
      }
      if (uav.next()) ++shows;
    }
    EXPECT_EQ(shows > 0, there);
  }
}

TEST(Showing, APhotographerThatWentAsideIsShownItsWayWhereItIs) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, "aside", 0);
    Shows uav(explorer_and_photographer(), 0);
    const double angle = random.uniform(0.0, 6.28), aside_m = random.uniform(0.8, 4.0);
    const Vector3d at_W(6.0 + aside_m * std::cos(angle), aside_m * std::sin(angle), random.uniform(0.3, 0.9));
    uav.peers.update(0, {{node_of_uav(UavIndex(1)), at_W, std::nullopt}});
    const auto goal = uav.next();
    ASSERT_TRUE(goal) << "seed " << seed;
    EXPECT_NEAR((goal->way.front().p_WB - at_W).head<2>().norm(), 5.0, 1e-6) << "seed " << seed;
    uav.clear({2.0, -4.0, 0.0}, {10.0, 4.0, 10.0});
    const bool beyond = std::abs(at_W.y()) > 2.3 || std::abs(at_W.x() - 6.0) > 2.3;
    EXPECT_NE(uav.showing.shown(uav.input()), beyond) << "seed " << seed << " at " << at_W.transpose();
  }
}

// The photographer may stand below a roof, so that its column cannot be seen from above. So the explorer also looks
// from below.
TEST(Showing, EachAttemptLooksFromAnotherHeight) {
  Shows uav(explorer_and_photographer(), 0);
  std::set<double> heights_m;
  for (int i = 0; i < 400; ++i, uav.k += 40) {
    if (const auto goal = uav.next()) heights_m.insert(goal->way.front().p_WB.z());
  }
  EXPECT_EQ(heights_m.size(), 4U);
  EXPECT_LT(*heights_m.begin(), 3.0);
  EXPECT_GT(*heights_m.rbegin(), 10.0);
}

TEST(Showing, APhotographerThatHasRisenIsNotShownItsWay) {
  Shows uav(explorer_and_photographer(), 0);
  uav.peers.update(0, {{node_of_uav(UavIndex(1)), Vector3d(6.0, 0.0, 0.2), std::nullopt}});
  ASSERT_TRUE(uav.next());
  uav.peers.update(ticks(0.1), {{node_of_uav(UavIndex(1)), Vector3d(6.0, 0.0, 5.0), std::nullopt}});
  EXPECT_TRUE(uav.showing.shown(uav.input()));
  uav.k += 10000;
  EXPECT_FALSE(uav.next());
}

}  // namespace
}  // namespace skein::agent
