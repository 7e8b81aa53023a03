// A UAV that must land gets down: at its start, elsewhere, or where it is.
#include "uav_agent/flight_core/landing.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

constexpr int kLandsWithin = 2400;  ///< in exchanges

AgentConfig with_a_mate_far_away(Role role) {
  AgentConfig agent;
  agent.fleet = {{.name = "a", .role = role}, {.name = "b", .p_WB_start = {0.0, 90.0, 0.0}}};
  return agent;
}

struct LandingUav : FlownUav {
  LandingUav(Role role, const Vector3d& at_W) : FlownUav(with_a_mate_far_away(role), at_W) {}
  /// @returns whether the UAV was sent into the ground, where it stands firm.
  bool land(int most_exchanges, bool must_sink) {
    for (int i = 0; i < most_exchanges && !down(); ++i) {
      Steering steering;
      const PlannerInput in = input();
      navigator.update(in);
      if (i == 0 && !begun) landing.begin(steering);
      begun = true;
      landing.step(in, must_sink, steering);
      fly(steering);
    }
    return down();
  }
  bool down() const { return tracker.tracking().setpoint.p_WB.z() < 0.0; }
  double off_m(const Vector3d& place_W) const { return (state.p_WB - place_W).head<2>().norm(); }

  Landing landing{config, agent, filter, navigator};
  bool begun = false;
};

TEST(Landing, IsAtTheStartIfPossible) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "landing", 0);
    LandingUav uav(seed % 2 == 0 ? Role::explorer : Role::photographer,
                   {random.uniform(-18.0, 18.0), random.uniform(-18.0, 18.0), random.uniform(4.0, 18.0)});
    uav.clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
    ASSERT_TRUE(uav.land(kLandsWithin, false)) << "seed " << seed;
    EXPECT_LT(uav.off_m(uav.agent.me().p_WB_start), 1.0) << "seed " << seed;
    EXPECT_EQ(uav.filter.trust(), SafetyFilter::Trust::proved) << "seed " << seed;
  }
}

// An explorer flies slowly where little space ahead is proved. Straight down, only the safety filter limits its speed.
TEST(Landing, AnExplorerThatMustSinkDoesNotCreepDown) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "creeps", 0);
    LandingUav uav(Role::explorer, {0.0, 0.0, random.uniform(20.0, 30.0)});
    uav.clear({-24.0, -24.0, 0.0}, {4.0, 24.0, 40.0});
    uav.navigator.want({{.id = 1, .way = {{Vector3d(60.0, 0.0, uav.state.p_WB.z()), 3.0}}}});
    for (int i = 0; i < 100; ++i) uav.navigate();
    ASSERT_LT(uav.navigator.pace_mps(), 1.5) << "seed " << seed;
    const double height_m = uav.state.p_WB.z();
    ASSERT_TRUE(uav.land(static_cast<int>(20.0 * (Landing::descent_s(height_m, uav.config) + 8.0)), true))
        << "seed " << seed << ": it is still at " << uav.state.p_WB.transpose();
  }
}

TEST(Landing, IsElsewhereIfSomethingStandsAtTheStart) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, "landing_elsewhere", 0);
    LandingUav uav(seed % 2 == 0 ? Role::explorer : Role::photographer,
                   {random.uniform(-18.0, 18.0), random.uniform(-18.0, 18.0), random.uniform(8.0, 18.0)});
    uav.clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 24.0});
    const double half_m = random.uniform(0.3, 1.5), top_m = random.uniform(1.6, 4.0);
    uav.build({-half_m, -half_m, 0.0}, {half_m, half_m, top_m});
    ASSERT_TRUE(uav.land(2 * kLandsWithin, false))
        << "seed " << seed << ", held at " << uav.state.p_WB.transpose() << ", half " << half_m << ", top " << top_m;
    EXPECT_GT(uav.off_m(Vector3d::Zero()), half_m + uav.agent.me().body_radius_m) << "seed " << seed;
  }
}

TEST(Landing, APhotographerWithoutAProvedWayTrustsUnknownSpace) {
  LandingUav uav(Role::photographer, {12.0, 5.0, 9.0});
  ASSERT_TRUE(uav.land(2 * kLandsWithin, false));
  EXPECT_EQ(uav.filter.trust(), SafetyFilter::Trust::unknown);
  EXPECT_LT(uav.off_m(uav.agent.me().p_WB_start), 1.0);
}

// Under the condition `battery`, UAVs in narrow shafts waited for a path until they could only just land, and one of
// them, held by another UAV below, fell with an empty battery.
TEST(Landing, AUavWithoutAPathToAnyPlaceComesDownWhereItIs) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "landing_shut_in", 0);
    const Vector3d at_W(random.uniform(11.0, 13.0), random.uniform(5.0, 6.0), random.uniform(4.0, 14.0));
    LandingUav uav(seed % 2 == 0 ? Role::explorer : Role::photographer, at_W);
    uav.clear({-24.0, -24.0, 0.0}, {24.0, 24.0, 20.0});
    const double half_m = random.uniform(3.0, 3.5), x = at_W.x(), y = at_W.y();
    uav.build({x - half_m - 1.0, y - half_m - 1.0, 0.0}, {x - half_m, y + half_m + 1.0, 40.0});
    uav.build({x + half_m, y - half_m - 1.0, 0.0}, {x + half_m + 1.0, y + half_m + 1.0, 40.0});
    uav.build({x - half_m, y - half_m - 1.0, 0.0}, {x + half_m, y - half_m, 40.0});
    uav.build({x - half_m, y + half_m, 0.0}, {x + half_m, y + half_m + 1.0, 40.0});
    ASSERT_TRUE(uav.land(kLandsWithin, false)) << "seed " << seed << ", still at " << uav.state.p_WB.transpose();
    EXPECT_LT(uav.off_m(at_W), 1.0) << "seed " << seed;
  }
}

TEST(Landing, AUavThatMustSinkComesDownWhereItIs) {
  LandingUav uav(Role::photographer, {12.0, 5.0, 9.0});
  ASSERT_TRUE(uav.land(kLandsWithin, true));
  EXPECT_LT(uav.off_m({12.0, 5.0, 0.0}), 0.5);
}

}  // namespace
}  // namespace skein::agent
