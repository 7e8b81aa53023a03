// Properties of every motion that the safety filter allows: random maps, paths and speeds. For other UAVs, see
// safety_filter_peers_test.cpp.
#include "uav_agent/flight_core/safety_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "uav_agent/testing/guarded_uav.hpp"

namespace skein::agent {
namespace {

/// The filter checks a path every 0.3 m, so the tube is slightly narrower between the checked places. Includes
/// rounding.
constexpr double kBetweenStepsM = 0.01;
/// An obstacle that the UAV flies away from may be within the tube by this distance [m]; measured: 0.035 m.
constexpr double kFliesAwayM = 0.05;

// In this test, no cell of the map becomes occupied. So the space around the UAV's braking path must be free at any
// time, whatever its commands. The tube widens with the speed, so an obstacle that the UAV flies away from may be in it
// for a while (kFliesAwayM).
TEST(SafetyFilter, CouldBrakeInFreeSpaceAtAnyTime) {
  double flown_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "free_space", 0);
    const Vector3d start_W(0.0, 0.0, random.uniform(0.2, 12.0));
    GuardedUav uav(start_W);
    uav.map.set_free(start_W, 3.0);
    carve(random, 8, static_cast<int>(random.bits() % 6), uav.map, start_W);
    uav.map.set_free(start_W, 3.0);
    if (!uav.filter.proved(start_W, uav.map, {})) continue;  // structure was drawn there
    for (int k = 0; k < 400; ++k) {
      if (k % 60 == 0) uav.fly(drawn_way(random, uav.tracker.commanded().p_WB));
      if (k % 20 == 0) uav.map.set_free(uav.state.p_WB + drawn_within(random, 6.0), random.uniform(1.0, 4.0));
      const Vector3d before_W = uav.tracker.moves() ? uav.tracker.commanded().p_WB : start_W;
      uav.step(random.uniform() < 0.1 ? random.uniform(0.2, 6.0) : 100.0);
      flown_m += (uav.state.p_WB - before_W).norm();
      const double radius_m = uav.filter.tube_m(uav.state.v_WB.norm()) - kBetweenStepsM;
      for (const Vector3d& p_W : uav.braking_way()) {
        for (const auto& cube : uav.not_free_about(p_W, radius_m)) {
          ASSERT_GT(uav.off_m(cube, {p_W}), uav.off_m(cube, {before_W}) - 1e-5) << "seed " << seed << " k " << k;
        }
      }
      uav.drift(random);
      ASSERT_TRUE(uav.not_free_about(uav.state.p_WB, kBodyM + kHaloM - kFliesAwayM).empty());
    }
  }
  EXPECT_GT(flown_m, 1000.0) << "a UAV that does not fly would prove nothing";
}

// The UAV sees an obstacle within its braking distance. The filter can no longer change the braking path, but it must
// not let the UAV come nearer to the obstacle than this path does.
TEST(SafetyFilter, ComesNoNearerToANewObstacleThanItsBrakingPath) {
  int broken = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    RandomStream random(seed, "appears", 0);
    GuardedUav uav({0.0, 0.0, 10.0});
    uav.config.tight_halo_m = kHaloM;
    uav.map.set_free({0.0, 0.0, 10.0}, 12.0);
    uav.fly({{drawn_within(random, 30.0) + Vector3d(0.0, 0.0, 30.0), random.uniform(1.0, 6.0)}});
    const int until = 5 + static_cast<int>(random.bits() % 40);
    for (int k = 0; k < until; ++k) uav.step();
    std::vector<Vector3d> rest_of_way = uav.braking_way();
    std::vector<WorldMap::Cube> seen;
    for (int i = 0; i < 3; ++i) {
      const Vector3d about_W = rest_of_way[random.bits() % rest_of_way.size()];
      seen.push_back(uav.map.cube_of(about_W + drawn_within(random, 2.5)));
      uav.map.hear(seen.back(), 0, Space::occupied, kOwn);
    }
    const double radius_m = uav.filter.tube_m(0.0);
    std::vector<double> least_m;
    for (const auto& cube : seen) least_m.push_back(std::min(radius_m, uav.off_m(cube, rest_of_way)));
    const std::uint64_t before = uav.filter.counts().slowed;
    for (int k = 0; k < 300; ++k) {
      if (k % 25 == 0) uav.fly(drawn_way(random, uav.map.cube_of(uav.state.p_WB).cast<double>() * 0.5));
      uav.drift(random);
      uav.step();
      for (std::size_t i = 0; i < seen.size(); ++i) {
        ASSERT_GT(uav.off_m(seen[i], {uav.tracker.commanded().p_WB}), least_m[i] - kBetweenStepsM)
            << "seed " << seed << " k " << k;
      }
    }
    broken += uav.filter.counts().slowed > before;
  }
  EXPECT_GT(broken, 40) << "nothing stood in the way";
}

// Too little space around the UAV is known, and commands repeatedly tell it to fly off. The filter holds the UAV at a
// fixed place and not at its measured position: this position swings, and with each swing forward the UAV would follow.
TEST(SafetyFilter, DoesNotCreepIntoTheUnknown) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "creeps", 0);
    const Vector3d ahead_W = drawn_within(random, 1.0).normalized();
    const double free_m = seed % 2 == 0 ? random.uniform(0.8, 1.6) : 8.0;  // little is free on all sides, or only ahead
    GuardedUav uav(Vector3d(0.0, 0.0, 20.0) + (free_m > 2.0 ? free_m - 1.2 : 0.0) * ahead_W);
    uav.config.tight_halo_m = kHaloM;  // as for a UAV that has had room for the full halo
    uav.map.set_free({0.0, 0.0, 20.0}, free_m);
    const Vector3d goal_W = uav.state.p_WB + 20.0 * ahead_W;
    uav.fly({{goal_W, 5.0}});
    uav.step();
    const Vector3d first_W = uav.tracker.commanded().p_WB;
    const auto unknown = uav.not_free_about(first_W, uav.filter.tube_m(0.0));
    ASSERT_FALSE(unknown.empty());
    for (int k = 0; k < 1000; ++k) {
      if (k % 10 == 0) uav.fly({{goal_W, random.uniform(0.5, 6.0)}});
      uav.drift(random);
      uav.step();
      for (const auto& cube : unknown) {
        ASSERT_GT(uav.off_m(cube, {uav.tracker.commanded().p_WB}), uav.off_m(cube, {first_W}) - 0.005)
            << "seed " << seed << " k " << k;
      }
    }
  }
}

// A UAV that was put down nearer to structure than the halo leaves slowly, with a smaller halo. Once it has had room,
// it keeps the full halo again.
TEST(SafetyFilter, LeavesAPlaceWithLittleRoomSlowly) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "tight", 0);
    GuardedUav uav({0.0, 0.0, 10.0});
    uav.map.set_free({0.0, 0.0, 10.0}, 14.0);
    const double angle = random.uniform(-3.0, 3.0), off_m = random.uniform(1.55, 1.8);
    std::vector<WorldMap::Cube> pole;
    for (double z = 6.0; z < 30.0; z += 0.5) {
      pole.push_back(uav.map.cube_of({off_m * std::cos(angle), off_m * std::sin(angle), z}));
      uav.map.hear(pole.back(), 0, Space::occupied, kOwn);
    }
    const double tight_m = std::min(uav.off_m(pole[8], {uav.state.p_WB}), kBodyM + uav.config.error_m);
    const Vector3d away_W(-std::cos(angle), -std::sin(angle), 0.0);
    uav.fly({{Vector3d(0.0, 0.0, 11.0) + 6.0 * away_W, 3.0}, {{0.0, 0.0, 14.0}, 3.0}});
    bool had_room = false;
    for (int k = 0; k < 600; ++k) {
      uav.step();
      const Vector3d here_W = uav.tracker.commanded().p_WB;
      double nearest_m = 1e9;
      for (const auto& cube : pole) nearest_m = std::min(nearest_m, uav.off_m(cube, {here_W}));
      had_room = had_room || nearest_m > uav.filter.tube_m(0.0);
      ASSERT_GT(nearest_m, had_room ? uav.filter.tube_m(0.0) - kFliesAwayM : tight_m - kBetweenStepsM) << seed;
      if (!had_room) {
        ASSERT_LT(uav.tracker.commanded().v_WB.norm(), uav.config.tight_mps + 0.05);
      }
    }
    EXPECT_TRUE(had_room) << "seed " << seed;
  }
}

// No UAV has a LiDAR: boxes are all that is known, and no UAV flies into one.
TEST(SafetyFilter, ABlindFleetKeepsOutOfBoxes) {
  double flown_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "blind", 0);
    GuardedUav uav({0.0, 0.0, 10.0}, fleet_of(1, Role::photographer, 0));
    for (int i = 0; i < 12; ++i) {
      OrientedBox box;
      box.center = drawn_in(random, {-15.0, -15.0, 0.0}, {15.0, 15.0, 20.0});
      box.size = drawn_in(random, {1.0, 1.0, 1.0}, {8.0, 8.0, 8.0});
      box.R_WO = Eigen::AngleAxisd(random.uniform(0.0, 3.0), Vector3d::UnitZ()).toRotationMatrix();
      if (!box.contains(uav.state.p_WB, 2.5)) uav.boxes.push_back(box);
    }
    const Vector3d start_W = uav.state.p_WB;
    for (int k = 0; k < 400; ++k) {
      if (k % 80 == 0) uav.fly(drawn_way(random, uav.state.p_WB));
      uav.step();
      uav.drift(random);
      for (const OrientedBox& box : uav.boxes) ASSERT_FALSE(box.contains(uav.state.p_WB, kBodyM)) << "seed " << seed;
    }
    flown_m += (uav.state.p_WB - start_W).norm();
  }
  EXPECT_GT(flown_m, 300.0);
}

// The UAV is nearer to a box than it may be, slightly or by much. It comes no nearer, but it may leave.
TEST(SafetyFilter, ABlindUavMayLeaveABoxThatItIsTooNearTo) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "leaves", 0);
    GuardedUav uav({0.0, 0.0, 10.0}, fleet_of(1, Role::photographer, 0));
    OrientedBox box;
    box.size = {4.0, 4.0, 20.0};
    const double off_m = uav.filter.tube_m(0.0) - (seed % 2 == 0 ? 1e-3 : random.uniform(0.01, 0.8));
    box.center = {2.0 + off_m, 0.0, 10.0};
    uav.boxes = {box};
    uav.fly({{{6.0, random.uniform(-1.0, 1.0), 10.0}, 3.0}});
    for (int k = 0; k < 100; ++k) uav.step();
    ASSERT_LT(uav.tracker.commanded().p_WB.x(), 1e-3) << "seed " << seed;
    uav.fly({{{-6.0, random.uniform(-3.0, 3.0), 10.0}, 3.0}});
    for (int k = 0; k < 200; ++k) uav.step();
    ASSERT_LT(uav.state.p_WB.x(), -5.9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
