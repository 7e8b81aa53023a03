#include "uav_agent/flight/escort.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "core/random_stream.hpp"
#include "uav_agent/testing/look_around.hpp"

namespace skein::agent {
namespace {

/// An explorer high above the middle, and photographers about it.
class OneExplorer : public testing::Test {
 protected:
  OneExplorer() {
    agent_.fleet = {{.name = "sees", .role = Role::explorer, .body_radius_m = 0.4}};
    agent_.vehicle.max_speed_mps = 5.0;
  }

  std::size_t add(const Vector3d& start_W, Role role = Role::photographer) {
    agent_.fleet.push_back({.name = "other", .role = role, .p_WB_start = start_W, .body_radius_m = 0.3});
    return agent_.fleet.size() - 1;
  }

  /// Everything anew, with one photographer.
  void one_alone_at(const Vector3d& start_W) {
    agent_.fleet.resize(1);
    add(start_W);
    escort_.emplace(agent_);
  }

  /// An exchange in which it is at rest. @returns what `act` does.
  template <class Do>
  auto at(const Vector3d& p_WB, double time_s, const std::vector<Neighbour>& seen, const Do& act) {
    Peers peers(agent_);
    peers.update(ticks(time_s), seen);
    TrackingState tracking;
    tracking.setpoint.p_WB = p_WB;
    tracking.done = true;
    tracking.airborne = true;
    RigidBodyState state;
    state.p_WB = p_WB;
    const PlannerInput in{.k = static_cast<std::uint64_t>(ticks(time_s) / 20),
                          .tick = ticks(time_s),
                          .state = state,
                          .gimbal = {},
                          .tracking = tracking,
                          .map = map_,
                          .boxes = boxes_,
                          .peers = peers,
                          .mission_remaining_s = 500.0 - time_s,
                          .detected = {},
                          .radio = {}};
    escort_->update(in);
    return act(in);
  }
  /// Where it goes to at such a time, if it does.
  std::optional<Vector3d> goal(double time_s, const Vector3d& here_W = {0.0, 0.0, 20.0},
                               const std::vector<Neighbour>& seen = {}) {
    return at(here_W, time_s, seen, [&](const PlannerInput& in) -> std::optional<Vector3d> {
      PlannerOutput out;
      if (!escort_->begin(in, {}, pilot_, out)) return std::nullopt;
      return std::get<Path>(out.motion).waypoints.back().p_WB;
    });
  }
  bool over(double time_s, const Vector3d& here_W, const std::vector<Neighbour>& seen = {}) {
    return at(here_W, time_s, seen, [&](const PlannerInput& in) { return escort_->step(in); });
  }
  Neighbour seen_at(std::size_t uav, const Vector3d& p_W) const {
    return {.node = node_of_uav(UavIndex(uav)), .p_W = p_W};
  }

  AgentConfig agent_;
  std::vector<OrientedBox> boxes_;
  OccupancyMap map_;
  Pilot pilot_{{}, agent_};
  std::optional<Escort> escort_{agent_};
};

TEST_F(OneExplorer, GoesNearWhoeverStandsFarOffWhenOthersHaveRisen) {
  RandomStream random(3, "escort", 0);
  for (int i = 0; i < 20; ++i) {
    const Vector3d start(random.uniform(20.0, 90.0), random.uniform(-60.0, 60.0), 0.1);
    one_alone_at(start);
    EXPECT_FALSE(goal(0.0).has_value());
    EXPECT_FALSE(goal(15.0).has_value()) << "it may rise by itself";
    const auto place = goal(25.0);
    ASSERT_TRUE(place.has_value());
    EXPECT_LT((*place - start).head<2>().norm(), Escort::kBesideM);
    EXPECT_GT(place->z(), 8.0);
  }
}

TEST_F(OneExplorer, IsOverWhenThatOneHasRisenAndGivenUpAfterSomeTries) {
  const std::size_t other = add({60.0, 0.0, 0.1});
  EXPECT_FALSE(goal(0.0).has_value());
  const auto place = goal(25.0);
  ASSERT_TRUE(place.has_value());
  EXPECT_FALSE(over(26.0, *place, {seen_at(other, {60.0, 0.0, 0.1})}));
  EXPECT_TRUE(over(30.0, *place, {seen_at(other, {60.0, 0.0, 6.0})}));
  EXPECT_FALSE(goal(80.0).has_value());

  escort_.emplace(agent_);
  goal(0.0);
  int tries = 0;
  double time_s = 25.0;
  for (; tries < 20 && goal(time_s).has_value(); ++tries) {
    while (!over(time_s += 1.0, *place)) ASSERT_LT(time_s, 490.0);
  }
  EXPECT_GT(tries, 1) << "lower down the next time";
  EXPECT_LT(tries, 8) << "it has other work";
}

TEST_F(OneExplorer, NobodyIsFetchedWhoStandsBesideAnExplorerOrNearerToAnotherOne) {
  add({6.0, 0.0, 0.1});
  add({60.0, 0.0, 0.1});
  add({70.0, 0.0, 0.1}, Role::explorer);
  goal(0.0);
  for (double time_s = 25.0; time_s < 200.0; time_s += 5.0) EXPECT_FALSE(goal(time_s).has_value());
}

TEST_F(OneExplorer, WhereNothingIsKnownItGoesNearerStepByStepAndNotForEver) {
  boxes_.resize(1);
  boxes_[0].center = {0.0, 0.0, 30.0};
  boxes_[0].size = {300.0, 300.0, 60.0};
  RandomStream random(4, "escort", 0);
  for (int i = 0; i < 5; ++i) {
    const Vector3d start(random.uniform(30.0, 50.0), random.uniform(-30.0, 30.0), 0.1);
    one_alone_at(start);
    map_ = OccupancyMap();
    Vector3d here(0.0, 0.0, 25.0);
    EXPECT_FALSE(goal(0.0, here).has_value());
    double time_s = 25.0;
    int stops = 0;
    for (; (here - start).head<2>().norm() > Escort::kBesideM; ++stops) {
      ASSERT_LT(stops, 12) << i;
      look_around(map_, here, 60);
      const auto next = goal(time_s, here);
      ASSERT_TRUE(next.has_value()) << i << " after " << stops << " stops";
      EXPECT_LT((*next - start).norm(), (here - start).norm() - 2.0);
      here = *next;
      while (!over(time_s += 1.0, here)) ASSERT_LT(time_s, 400.0);
    }
    EXPECT_GT(stops, 2) << "step by step";
  }
}

TEST_F(OneExplorer, ItDoesOtherWorkMostOfTheTime) {
  RandomStream random(5, "escort", 0);
  for (int i = 0; i < 30; ++i) add({random.uniform(-90.0, 90.0), random.uniform(-90.0, 90.0), 0.1});
  escort_.emplace(agent_);
  goal(0.0);
  double away_s = 0.0;
  Vector3d here(0.0, 0.0, 20.0);
  for (double time_s = 25.0; time_s < 490.0; time_s += 1.0) {
    const auto place = goal(time_s, here);
    if (!place) continue;
    here = *place;
    const double set_out_s = time_s;
    while (!over(time_s += 1.0, here)) ASSERT_LT(time_s, 500.0);
    away_s += time_s - set_out_s;
  }
  EXPECT_GT(away_s, 60.0);
  EXPECT_LT(away_s, 200.0) << "of 500";
}

}  // namespace
}  // namespace skein::agent
