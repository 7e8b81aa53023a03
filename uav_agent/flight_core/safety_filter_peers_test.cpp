// UAVs stay apart with every motion that their safety filters allow: random paths, speeds and latencies.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "uav_agent/testing/guarded_uav.hpp"

namespace skein::agent {
namespace {

// Of two UAVs that stand side by side, one seems higher than the other, because their odometry errs. That must not keep
// the other one on the ground. A UAV that hovers above the ground, or moves, must.
TEST(SafetyFilter, AUavClimbsBesideAStandingUavThatReportsAWrongHeight) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "stands_beside", 0);
    AgentConfig agent;
    const double heading = random.uniform(-3.1, 3.1), off_m = random.uniform(1.1, 1.6);
    const Vector3d beside_W(off_m * std::cos(heading), off_m * std::sin(heading), 0.16);
    agent.fleet = {{.name = "a", .p_WB_start = {0.0, 0.0, 0.16}}, {.name = "b", .p_WB_start = beside_W}};
    agent.odometry = conditions_preset("harsh").odometry;
    FlownUav uav(agent, {0.0, 0.0, 0.16});
    uav.clear({-12.0, -12.0, 0.0}, {12.0, 12.0, 12.0});
    const Vector3d deviation_m = deviation_in_flight_m(agent.odometry);
    uav.filter.expect({.peers_m = {Vector3d::Zero(), 2.0 * deviation_m}});
    const auto climbs = [&](double told_m, const Vector3d& v_W) {
      Peers peers(uav.agent);
      peers.update(uav.input().tick, {{node_of_uav(UavIndex{1}), beside_W + Vector3d(0.0, 0.0, told_m), v_W}});
      return uav.filter.clear_up_to(3.0, {uav.input().tick, uav.state, uav.map, uav.boxes, peers});
    };
    EXPECT_TRUE(climbs(random.uniform(0.0, 1.0) * std::sqrt(2.0) * agent.odometry.bias_sigma_m, Vector3d::Zero()));
    EXPECT_FALSE(climbs(random.uniform(1.6, 2.4), Vector3d::Zero())) << seed << ": it hovers";
    held += climbs(random.uniform(0.3, 1.0), {0.0, 0.0, random.uniform(0.6, 2.0)}) ? 0 : 1;
  }
  EXPECT_GT(held, 20) << "a UAV that climbs blocks the place that it reports";
}

// Each UAV wants to fly to the place of the other one, or across its path.
TEST(SafetyFilter, TwoUavsNeverTouch) {
  double nearest_m = 1e9;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    RandomStream random(seed, "two_uavs", 0);
    TwoGuardedUavs two(random, static_cast<int>(seed % 2));
    for (int k = 0; k < 400; ++k) {
      if (k % 80 == 0) {
        const Vector3d meet_W = drawn_in(random, {-4.0, -4.0, 8.0}, {4.0, 4.0, 14.0});
        for (auto& uav : two.uavs) {
          const Vector3d beyond_W = meet_W + (meet_W - uav->state.p_WB) + drawn_within(random, 3.0);
          uav->fly(
              {{meet_W + drawn_within(random, 1.0), random.uniform(0.5, 6.0)}, {beyond_W, random.uniform(0.5, 6.0)}});
        }
      }
      two.step(true, random);
      nearest_m = std::min(nearest_m, two.apart_m());
      ASSERT_GT(two.apart_m(), 2.0 * kBodyM) << "seed " << seed << " k " << k;
    }
  }
  EXPECT_LT(nearest_m, 3.0) << "they never met";
}

constexpr double kSoftMps2 = 2.0;

/// Least distance between two UAVs that begin to brake 0.1 s after now.
double braking_least_m(const RigidBodyState& one, const RigidBodyState& other, double brakes_mps2) {
  static constexpr double kDelayS = 0.1, kStepS = 0.02, kForS = 3.0;
  const auto at_W = [&](const RigidBodyState& state, double t_s) -> Vector3d {
    const double speed_mps = state.v_WB.norm(), brakes_s = std::clamp(t_s - kDelayS, 0.0, speed_mps / brakes_mps2);
    if (speed_mps <= 0.0) return state.p_WB;
    const double way_m = speed_mps * (std::min(t_s, kDelayS) + brakes_s) - 0.5 * brakes_mps2 * brakes_s * brakes_s;
    return state.p_WB + state.v_WB * (way_m / speed_mps);
  };
  double least_m = 1e9;
  for (double t_s = 0.0; t_s < kForS; t_s += kStepS) {
    least_m = std::min(least_m, (at_W(one, t_s) - at_W(other, t_s)).norm());
  }
  return least_m;
}

// Both rest, and receive the command to fly to the other one's place in the same exchange: each accelerates before it
// hears that the other one does.
TEST(SafetyFilter, TwoUavsThatSetOutAtOnceKeepTheirMargin) {
  double nearest_m = 1e9, braking_m = 1e9;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "set_out_at_once", 0);
    TwoGuardedUavs two(random, static_cast<int>(seed % 2));
    const Vector3d from_W = two.uavs[0]->state.p_WB;
    const Vector3d to_W = from_W + random.uniform(3.5, 8.0) * drawn_within(random, 1.0).normalized();
    two.uavs[1]->state.p_WB = to_W;
    two.uavs[0]->fly({{2.0 * to_W - from_W, 5.0}});
    two.uavs[1]->fly({{2.0 * from_W - to_W, 5.0}});
    for (int k = 0; k < 120; ++k) {
      two.step(true, random);
      nearest_m = std::min(nearest_m, two.apart_m());
      braking_m = std::min(braking_m, braking_least_m(two.uavs[0]->state, two.uavs[1]->state, kSoftMps2));
    }
  }
  EXPECT_GT(braking_m, 2.0 * kBodyM + 0.3);
  EXPECT_GT(nearest_m, 2.0 * kBodyM + 0.3);
  EXPECT_LT(nearest_m, 2.6) << "they never met";
}

// Real bodies follow their commands late, and two UAVs that have braked for each other speed up again in the same
// exchange. Each wants to pass where the other one is, again and again.
TEST(SafetyFilter, TwoUavsThatFollowTheirCommandsLateCouldAlwaysBrake) {
  static constexpr double kBrakesMps2 = 2.8;
  for (const std::size_t late : {4, 5, 6}) {
    double braking_m = 1e9;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      RandomStream random(seed, "late_bodies", late);
      TwoGuardedUavs two(random, static_cast<int>(seed % 2), late);
      std::array<int, 2> next = {0, 0};
      for (int k = 0; k < 300; ++k) {
        for (std::size_t i = 0; i < 2; ++i) {
          if (k < next[i]) continue;
          const Vector3d from_W = two.uavs[i]->state.p_WB, to_W = two.uavs[1 - i]->state.p_WB;
          two.uavs[i]->fly({{from_W + 1.6 * (to_W - from_W) + drawn_within(random, 2.0), 5.0}});
          next[i] = k + 20 + static_cast<int>(random.bits() % 80);
        }
        two.step(true, random);
        braking_m = std::min(braking_m, braking_least_m(two.uavs[0]->state, two.uavs[1]->state, kBrakesMps2));
      }
    }
    EXPECT_GT(braking_m, 2.0 * kBodyM + 0.27) << "bodies follow " << late << " exchanges late";
    EXPECT_LT(braking_m, 3.5) << "they never met";
  }
}

// Both UAVs turn onto each other's paths at the same time. The velocity that a UAV reports before its turn predicts
// another path than that on which it brakes after it.
TEST(SafetyFilter, TwoUavsThatTurnTowardsEachOtherKeepTheirDistance) {
  double nearest_m = 1e9;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    RandomStream random(seed, "turn_towards", 0);
    TwoGuardedUavs two(random, static_cast<int>(seed % 2));
    const Vector3d meet_W = 0.5 * (two.uavs[0]->state.p_WB + two.uavs[1]->state.p_WB);
    const Vector3d along = drawn_within(random, 1.0).normalized();
    for (const double side : {1.0, -1.0}) {
      GuardedUav& uav = *two.uavs[side > 0.0 ? 0 : 1];
      const Vector3d corner_W = meet_W + side * random.uniform(3.0, 6.0) * along;
      const Vector3d off = (side * along + drawn_within(random, 1.5)).normalized();
      uav.state.p_WB = corner_W + random.uniform(3.0, 7.0) * off;
      uav.fly({{corner_W, random.uniform(3.0, 5.0)}, {corner_W - 14.0 * side * along, 5.0}});
    }
    if (two.apart_m() < 3.5) continue;
    for (int k = 0; k < 120; ++k) {
      two.step(true, random);
      nearest_m = std::min(nearest_m, two.apart_m());
    }
  }
  EXPECT_GT(nearest_m, 2.0 * kBodyM + 0.3);
  EXPECT_LT(nearest_m, 2.6) << "they never met";
}

// One UAV goes out of sight and comes to rest there. The other one keeps off, although it hears no more of the first.
TEST(SafetyFilter, KeepsOffAUavThatWentOutOfSight) {
  double nearest_m = 1e9;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "out_of_sight", 0);
    TwoGuardedUavs two(random, static_cast<int>(seed % 2));
    const std::size_t rests = random.bits() % 2;
    const int lost = 10 + static_cast<int>(random.bits() % 60);
    GuardedUav &still = *two.uavs[rests], &other = *two.uavs[1 - rests];
    still.fly(drawn_way(random, still.state.p_WB));
    for (int k = 0; k < lost + 300; ++k) {
      if (k == lost) still.tracker.hold();
      if (k % 60 == 0) other.fly({{2.0 * still.state.p_WB - other.state.p_WB, random.uniform(1.0, 6.0)}});
      two.step(k < lost, random);
      nearest_m = std::min(nearest_m, two.apart_m());
      ASSERT_GT(two.apart_m(), 2.0 * kBodyM) << "seed " << seed << " k " << k;
    }
  }
  EXPECT_LT(nearest_m, 3.0) << "they never met";
}

// A UAV brakes and will stop obliquely in front of another one. The other one is just outside the space that the first
// may sweep if it brakes as weakly as the filter assumes, and wants to fly to where the first comes from.
TEST(SafetyFilter, NoUavComesNearerToOneThatBrakesInFrontOfIt) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, "brakes_in_front", 0);
    GuardedUav uav({0.5, 0.5, 20.0}, fleet_of(2, Role::explorer, 0));
    uav.map.set_free(uav.state.p_WB, 9.0);
    const Vector3d start_W = uav.state.p_WB, from_W = drawn_within(random, 1.0).normalized();
    const double speed_mps = random.uniform(4.0, 5.0), brakes_mps2 = 2.8;
    const double apart_m = uav.filter.apart_m(1, 0.0), rests_m = apart_m + random.uniform(0.02, 0.3);
    const double aside_m = random.uniform(0.8, 1.8);
    const Vector3d rest_W =
        start_W + std::sqrt(rests_m * rests_m - aside_m * aside_m) * from_W + aside_m * from_W.unitOrthogonal();
    uav.fly({{start_W + 6.0 * from_W, 5.0}});
    for (int k = 0; k < 200; ++k) {
      const double left_s = std::max(0.0, speed_mps / brakes_mps2 - k * kPeriodS);
      const Vector3d p_W = rest_W + 0.5 * brakes_mps2 * left_s * left_s * from_W;
      const Vector3d v_W = -brakes_mps2 * left_s * from_W;
      uav.peers.update(uav.tick, {Neighbour{.node = node_of_uav(UavIndex(1)), .p_W = p_W, .v_W = v_W}});
      uav.step();
      ASSERT_GT((uav.state.p_WB - p_W).norm(), apart_m - 0.02) << "seed " << seed << " k " << k;
    }
  }
}

}  // namespace
}  // namespace skein::agent
