// Whole fleets, without physics, that start close together beside walls: every UAV gets away, although at first each
// has another one or a wall in its way.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"
#include "tests/support/test_program.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

double radius_m(Role role) { return role == Role::explorer ? kExplorerRadiusM : kPhotographerRadiusM; }

struct Crowd {
  TestScene scene;
  std::vector<TestUav> fleet;
};

/// Four to seven UAVs in a street between two walls, or in the corner of two, a few centimetres to a metre apart.
Crowd drawn_crowd(std::uint64_t seed) {
  RandomStream random(seed, "crowded_starts_test", 0);
  Crowd crowd;
  const double wide_m = random.uniform(5.0, 8.0);
  crowd.scene.boxes = {make_box({40.0, 0.0, 8.0}, {10.0, 10.0, 16.0})};
  crowd.scene.solids = {make_box({40.0, 0.0, 7.0}, {6.0, 6.0, 14.0}), make_box({0.0, -1.0, 4.0}, {14.0, 2.0, 8.0})};
  const bool street = random.uniform() < 0.5;
  crowd.scene.solids.push_back(street ? make_box({0.0, wide_m + 1.0, 4.0}, {14.0, 2.0, 8.0})
                                      : make_box({-4.0, 4.0, 4.0}, {2.0, 8.0, 8.0}));
  const std::size_t explorers = random.uniform() < 0.5 ? 1 : 2;
  const auto count = static_cast<std::size_t>(random.uniform(4.0, 8.0));
  for (int tries = 0; crowd.fleet.size() < count && tries < 2000; ++tries) {
    TestUav uav{.name = "u" + std::to_string(crowd.fleet.size()),
                .role = crowd.fleet.size() < explorers ? Role::explorer : Role::photographer,
                .start = {random.uniform(-1.5, 1.5), random.uniform(1.4, street ? wide_m - 1.4 : 4.5)}};
    const auto fits = [&](const TestUav& other) {
      const double gap_m = (uav.start - other.start).norm() - radius_m(uav.role) - radius_m(other.role);
      return gap_m > 0.05;
    };
    if (std::ranges::all_of(crowd.fleet, fits)) crowd.fleet.push_back(uav);
  }
  return crowd;
}

TEST(CrowdedStarts, EveryUavGetsAway) {
  std::size_t uavs = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Crowd crowd = drawn_crowd(seed);
    TestWorld world(crowd.scene, crowd.fleet, "patrol", 150.0);
    world.run(120.0);
    for (std::size_t i = 0; i < crowd.fleet.size(); ++i) {
      EXPECT_GT(world.highest_m(i), 3.0) << "seed " << seed << ", UAV " << i << " at " << world.position(i).transpose()
                                         << ", started at " << crowd.fleet[i].start.transpose();
    }
    EXPECT_GT(world.gap(), 0.0) << "seed " << seed;
    EXPECT_GT(world.clearance(), kPhotographerRadiusM) << "seed " << seed;
    uavs += crowd.fleet.size();
  }
  EXPECT_GE(uavs, 32U);
}

/// A tight group of one explorer and four or five photographers below a canopy that is wider than the group.
Crowd drawn_group_below_a_canopy(std::uint64_t seed) {
  RandomStream random(seed, "crowded_starts_test", 1);
  Crowd crowd;
  crowd.scene.boxes = {make_box({40.0, 0.0, 8.0}, {10.0, 10.0, 16.0})};
  const double low_m = random.uniform(7.5, 9.0);
  crowd.scene.solids = {make_box({40.0, 0.0, 7.0}, {6.0, 6.0, 14.0}),
                        make_box({0.0, 0.0, low_m + 0.25}, {8.0, 8.0, 0.5})};
  const std::size_t count = random.uniform() < 0.5 ? 5 : 6;
  while (crowd.fleet.size() < count) {
    constexpr double side_m = 1.5;
    TestUav uav{.name = "u" + std::to_string(crowd.fleet.size()),
                .role = crowd.fleet.empty() ? Role::explorer : Role::photographer,
                .start = {random.uniform(-side_m, side_m), random.uniform(-side_m, side_m)}};
    const auto fits = [&](const TestUav& other) {
      return (uav.start - other.start).norm() - radius_m(uav.role) - radius_m(other.role) > 0.05;
    };
    if (std::ranges::all_of(crowd.fleet, fits)) crowd.fleet.push_back(uav);
  }
  return crowd;
}

// The explorer rises until the canopy stops it, and the others rise until the explorer stops them. Then no UAV can fly
// past another one until those that rest make room.
TEST(CrowdedStarts, EveryUavGetsAwayBelowACanopy) {
  const char* const planners[] = {"star", "flock", "kios"};
  for (const std::uint64_t seed : {1, 2, 3, 9, 10, 11}) {
    if (!has_turn(seed / 8, 2)) continue;  // three seeds at each commit, one for each planner
    const Crowd crowd = drawn_group_below_a_canopy(seed);
    TestWorld world(crowd.scene, crowd.fleet, planners[seed % 3], 200.0);
    world.run(150.0);
    for (std::size_t i = 0; i < crowd.fleet.size(); ++i) {
      EXPECT_GT((world.position(i).head<2>() - crowd.fleet[i].start).norm(), 6.0)
          << "seed " << seed << ", " << planners[seed % 3] << ", UAV " << i << " at " << world.position(i).transpose();
    }
    EXPECT_GT(world.gap(), 0.0) << "seed " << seed;
    EXPECT_GT(world.clearance(), kPhotographerRadiusM) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skein::agent
