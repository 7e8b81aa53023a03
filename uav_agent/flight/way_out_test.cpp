// A way out where one is: never where the rules do not let it, and with less care only when it is asked for.
#include "uav_agent/flight/way_out.hpp"

#include <gtest/gtest.h>

#include "core/random_stream.hpp"
#include "uav_agent/testing/look_around.hpp"

namespace skein::agent {
namespace {

const std::vector<OrientedBox> kNoBoxes;

TEST(WayOut, LeadsAwayAndAttemptsDiffer) {
  const OccupancyMap map;
  const Vector3d here(0, 0, 20);
  const FreeSpace space({}, kNoBoxes, map);
  const auto first = find_way_out(space, kNoBoxes, here, 0), second = find_way_out(space, kNoBoxes, here, 1);
  ASSERT_TRUE(first && second);
  EXPECT_GT((first->back() - here).norm(), 5.0);
  EXPECT_GT((first->back() - second->back()).norm(), 3.0);
}

TEST(WayOut, KeepsItsClearanceInDrawnWorlds) {
  for (std::uint64_t world = 0; world < 40; ++world) {
    RandomStream random(world, "way_out_test", 0);
    OccupancyMap map;
    std::vector<Eigen::Vector3f> hits;
    for (int i = 0; i < 60; ++i) {
      const Vector3d p(random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(8, 32));
      if ((p - Vector3d(0, 0, 20)).norm() > 4.0) hits.push_back(p.cast<float>());
    }
    map.insert(hits, std::nullopt);
    const FreeSpace space({.clearance_m = 1.8}, kNoBoxes, map);
    const auto way = find_way_out(space, kNoBoxes, {0, 0, 20}, static_cast<int>(world % 5));
    if (way) {
      EXPECT_TRUE(space.free(way->back())) << world;
    }
  }
}

TEST(WayOut, ThereIsNoneThroughWhatNobodyHasSeen) {
  OrientedBox around;  // all of it unseen
  around.center = {0, 0, 20};
  around.size = {80, 80, 60};
  const std::vector<OrientedBox> boxes = {around};
  OccupancyMap map;
  for (int attempt = 0; attempt < 6; ++attempt) {
    const FreeSpace space(less_careful({}, attempt, 1.0), boxes, map);
    EXPECT_FALSE(find_way_out(space, boxes, {0, 0, 20}, attempt)) << attempt;
  }
  look_around(map, {0, 0, 20}, 80);
  FreeSpace::Config config;
  config.enter_radius_m = 100.0;
  EXPECT_TRUE(find_way_out(FreeSpace(config, boxes, map), boxes, {0, 0, 20}, 0)) << "now it has been looked at";
}

TEST(LessCareful, AsksForLessEachTimeButNeverForTooLittle) {
  FreeSpace::Config space;
  space.rays = 16;
  space.clearance_m = 2.4;
  FreeSpace::Config before = less_careful(space, 0, 1.1);
  EXPECT_EQ(before.rays, 16);
  EXPECT_EQ(before.clearance_m, 2.4);
  for (int attempt = 1; attempt < 10; ++attempt) {
    const FreeSpace::Config now = less_careful(space, attempt, 1.1);
    EXPECT_LE(now.rays, before.rays);
    EXPECT_LE(now.clearance_m, before.clearance_m);
    EXPECT_GE(now.rays, 4);
    EXPECT_GE(now.clearance_m, 1.1);
    before = now;
  }
}

}  // namespace
}  // namespace skein::agent
