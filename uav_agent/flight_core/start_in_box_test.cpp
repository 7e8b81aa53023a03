// UAVs that start in a box, and assume that boxes are structure because no map proves space free.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/core_uav.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kBoxedUavM = 0.32;  ///< radius of the body

OrientedBox drawn_box_around(RandomStream& random, const Vector3d& start_W) {
  OrientedBox box;
  box.size = {random.uniform(14.0, 60.0), random.uniform(14.0, 60.0), random.uniform(6.0, 45.0)};
  box.R_WO = Eigen::AngleAxisd(random.uniform(-3.1, 3.1), Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d off_O(random.uniform(-0.45, 0.45) * box.size.x(), random.uniform(-0.45, 0.45) * box.size.y(), 0.0);
  box.center = start_W + box.R_WO * off_O;
  box.center.z() = 0.5 * box.size.z() + random.uniform(-1.0, 0.5);
  return box;
}

/// A photographer whose explorer is lost, or that has none.
struct BoxedUav : CoreUav {
  BoxedUav(bool has_explorer, RandomStream& random, double height_m)
      : CoreUav(fleet(has_explorer), {0.0, 0.0, height_m}) {
    lidar_works = false;
    map.set_free({0.0, 0.0, 0.16}, 1.2);
    const OrientedBox box = drawn_box_around(random, agent.me().p_WB_start);
    boxes = {box};
    if (random.bits() % 2 == 0) {  // another one stands on it
      const double bottom_m = box.center.z() + 0.5 * box.size.z() + random.uniform(-3.0, 1.0);
      boxes.push_back(make_box({0.0, 0.0, bottom_m + 3.0}, {6.0, 6.0, 6.0}, random.uniform(-3.1, 3.1)));
    }
    const double turn = random.uniform(-3.1, 3.1);
    const double off_m = 0.5 * box.size.head<2>().norm() + random.uniform(4.0, 8.0);
    outside_W = box.center + off_m * Vector3d(std::cos(turn), std::sin(turn), 0.0);
    outside_W.z() = random.uniform(4.0, 12.0);
  }
  static AgentConfig fleet(bool has_explorer) {
    AgentConfig agent;
    agent.fleet = {
        {.name = "a", .role = Role::photographer, .p_WB_start = {0.0, 0.0, 0.0}, .body_radius_m = kBoxedUavM}};
    agent.battery.endurance_missions = 1.0;
    if (has_explorer) agent.fleet.push_back({.name = "b", .p_WB_start = {0.0, 200.0, 0.0}});
    return agent;
  }
  /// Flies to outside_W, which the strategy asks for whenever the core is idle. @returns whether it got there.
  bool flies_outside(double most_s) {
    bool reached = false;
    for (double now_s = 0.0; now_s < most_s && !reached; now_s += agent.exchange_period_s) {
      PlannerInput in = input();
      in.battery = battery;
      core.update(in);
      in.flight = core.state();
      for (const Outcome& outcome : in.flight.outcomes) reached |= outcome.kind == Outcome::Kind::reached;
      std::optional<std::vector<Goal>> goals;
      if (in.flight.working && in.flight.idle) goals = {{.id = ++id, .way = {{outside_W, 4.0}}}};
      exchange(in, std::move(goals));
    }
    return reached;
  }
  void exchange(const PlannerInput& in, std::optional<std::vector<Goal>> goals) {
    fly_by(core.step(in, std::move(goals)));
    const Vector3d& p_W = tracker.commanded().p_WB;
    const auto is_in = [&](const OrientedBox& box) { return box.contains(p_W, kBoxedUavM); };
    if (std::ranges::any_of(boxes, is_in)) {
      most_aside_m = std::max(most_aside_m, p_W.head<2>().norm());
    } else {
      got_out = true;
    }
  }
  std::optional<BatteryStatus> battery;
  Vector3d outside_W = Vector3d::Zero();
  std::int64_t id = 0;
  double most_aside_m = 0.0;  ///< from above the start, while it was in a box
  bool got_out = false;       ///< whether it has been outside all boxes
};

TEST(StartInBox, AUavThatReceivesNoMapClimbsStraightUpOutOfTheBox) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "boxed", 0);
    BoxedUav uav(seed % 2 == 0, random, 0.16);
    EXPECT_TRUE(uav.flies_outside(240.0)) << "seed " << seed << ": it is at " << uav.state.p_WB.transpose();
    EXPECT_LT(uav.most_aside_m, 1.0) << "seed " << seed;
  }
}

// The UAV was restarted in the box, or had climbed a little before its explorer was lost.
TEST(StartInBox, AUavThatHoversInTheBoxGetsOutOfIt) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed, "boxed_hovers", 0);
    BoxedUav uav(seed % 2 == 0, random, random.uniform(2.5, 4.5));
    uav.flies_outside(400.0);  // one that comes down too close to a box's side may be held there for longer
    EXPECT_TRUE(uav.got_out) << "seed " << seed << ": it is at " << uav.state.p_WB.transpose();
    EXPECT_LT(uav.most_aside_m, 1.0) << "seed " << seed;
  }
}

TEST(StartInBox, AUavWhoseBatteryIsLowLandsInTheBox) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "boxed_lands", 0);
    BoxedUav uav(false, random, 0.16);
    ASSERT_TRUE(uav.flies_outside(240.0)) << "seed " << seed;
    uav.battery = BatteryStatus{.charge = 0.22};
    for (int i = 0; i < 20 * 300 && uav.tracker.commanded().p_WB.z() > 0.0; ++i) {
      uav.battery->charge -= 1e-5;
      PlannerInput in = uav.input();
      in.battery = uav.battery;
      uav.core.update(in);
      in.flight = uav.core.state();
      uav.exchange(in, std::nullopt);
    }
    EXPECT_LE(uav.tracker.commanded().p_WB.z(), 0.0) << "seed " << seed;
    EXPECT_LT(uav.state.p_WB.head<2>().norm(), 1.0) << "seed " << seed << ": it is at " << uav.state.p_WB.transpose();
    EXPECT_LT(uav.most_aside_m, 1.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
