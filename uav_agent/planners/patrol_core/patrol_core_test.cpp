// Patrol on the flight core in a world without physics: the same as is asked of patrol (patrol_test.cpp), where
// distances between UAVs are those between their bodies.
#include <gtest/gtest.h>

#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kLargerBodyM = 0.63;

TEST(PatrolCore, PhotographsTheStructureAndBringsItHome) {
  TestWorld world(two_towers(), test_fleet(3), "patrol_core", 300.0);
  world.run(300.0);
  EXPECT_GT(world.coverage(), 0.9);
  EXPECT_GT(world.clearance(), kLargerBodyM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only those of the last seconds";
}

TEST(PatrolCore, IsRepeatable) {
  TestWorld once(two_towers(), test_fleet(3), "patrol_core", 100.0);
  TestWorld again(two_towers(), test_fleet(3), "patrol_core", 100.0);
  once.run(60.0);
  again.run(60.0);
  EXPECT_EQ(once.fingerprint(), again.fingerprint());
}

class PatrolCoreFleets : public testing::TestWithParam<std::size_t> {};

TEST_P(PatrolCoreFleets, NobodyTouchesAnything) {
  TestWorld world(two_towers(), test_fleet(GetParam()), "patrol_core", 150.0);
  world.run(150.0);
  EXPECT_GT(world.clearance(), kLargerBodyM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_GT(world.coverage(), GetParam() == 1 ? 0.1 : 0.3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PatrolCoreFleets, testing::Values(1U, 2U, 5U, 8U));

TEST(PatrolCore, WorksWithoutAnyLidar) {
  TestWorld world(two_towers(), {{"eye", Role::photographer, {-8.0, -14.0}}}, "patrol_core", 200.0);
  world.run(200.0);
  EXPECT_GT(world.coverage(), 0.2) << "from in front of the boxes";
  EXPECT_GT(world.clearance(), 0.32 + 0.5);
}

TEST(PatrolCore, WorksAloneInTheDark) {
  TestScene scene = two_towers();
  scene.radio = false;
  TestWorld world(scene, {{"a", Role::explorer, {-8.0, -14.0}}}, "patrol_core", 300.0);
  world.run(300.0);
  EXPECT_GT(world.coverage(), 0.25) << "it flies no faster than it proves: the survey alone takes 100 s";
  EXPECT_GT(world.clearance(), kLargerBodyM + 0.5);
}

TEST(PatrolCore, BoxesMayComeLate) {
  TestScene scene = two_towers();
  scene.boxes_at_s = 20.0;
  TestWorld world(scene, test_fleet(2), "patrol_core", 200.0);
  world.run(200.0);
  EXPECT_GT(world.coverage(), 0.3);
  EXPECT_GT(world.clearance(), kLargerBodyM + 0.5);
}

/// One box around a whole site, as the contest of 2024 had: where the structure is, only the map can tell.
TEST(PatrolCore, FindsTheStructureInABoxThatHoldsEverything) {
  TestScene scene = two_towers();
  scene.boxes = {make_box({16.0, 12.0, 16.0}, {64.0, 56.0, 33.0}, 0.2)};
  TestWorld world(scene, test_fleet(3), "patrol_core", 400.0);
  world.run(400.0);
  EXPECT_GT(world.coverage(), 0.6);
  EXPECT_GT(world.clearance(), kLargerBodyM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only those of the last seconds";
}

}  // namespace
}  // namespace skein::agent
