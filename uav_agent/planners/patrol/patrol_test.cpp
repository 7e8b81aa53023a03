// Tests the patrol planner in TestWorld, a world without physics: UAVs must keep their distance from the structure and
// from each other, and must photograph the structure and deliver their captures. clearance() is the least distance from
// a UAV's centre to the structure, gap() the least distance between the bodies of two UAVs [m].
#include <gtest/gtest.h>

#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

TEST(Patrol, PhotographsTheStructureAndDeliversThePictures) {
  TestWorld world(two_towers(), test_fleet(3), "patrol", 300.0);
  world.run(300.0);
  EXPECT_GT(world.coverage(), 0.9);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only captures of the last seconds are left";
}

TEST(Patrol, IsRepeatable) {
  TestWorld once(two_towers(), test_fleet(3), "patrol", 100.0);
  TestWorld again(two_towers(), test_fleet(3), "patrol", 100.0);
  once.run(60.0);
  again.run(60.0);
  EXPECT_EQ(once.fingerprint(), again.fingerprint());
}

class PatrolFleets : public testing::TestWithParam<std::size_t> {};

TEST_P(PatrolFleets, NoUavTouchesAnything) {
  TestWorld world(two_towers(), test_fleet(GetParam()), "patrol", 150.0);
  world.run(150.0);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_GT(world.coverage(), GetParam() == 1 ? 0.1 : 0.3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PatrolFleets, testing::Values(1U, 2U, 5U, 8U));

TEST(Patrol, PhotographsWithoutAnyLidar) {
  TestWorld world(two_towers(), {{"eye", Role::photographer, {-8.0, -14.0}}}, "patrol", 200.0);
  world.run(200.0);
  EXPECT_GT(world.coverage(), 0.2) << "it photographs from in front of the boxes";
  EXPECT_GT(world.clearance(), kPhotographerRadiusM + 0.5);
}

TEST(Patrol, PhotographsAloneWithoutRadio) {
  TestScene scene = two_towers();
  scene.radio = false;
  TestWorld world(scene, {{"a", Role::explorer, {-8.0, -14.0}}}, "patrol", 200.0);
  world.run(200.0);
  EXPECT_GT(world.coverage(), 0.25) << "it is slow, because it flies no faster than it proves space";
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
}

TEST(Patrol, PhotographsAlsoIfBoxesComeLate) {
  TestScene scene = two_towers();
  scene.boxes_at_s = 20.0;
  TestWorld world(scene, test_fleet(2), "patrol", 200.0);
  world.run(200.0);
  EXPECT_GT(world.coverage(), 0.3);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
}

TEST(Patrol, WithoutBoxesItStaysWhereItIs) {
  TestScene scene = two_towers();
  scene.boxes.clear();
  TestWorld world(scene, test_fleet(2), "patrol", 60.0);
  world.run(60.0);
  for (const std::size_t uav : {0U, 1U}) EXPECT_LT(world.highest_m(uav), 8.0);
}

TEST(Patrol, FliesSafelyAndPhotographsAmongManyBoxes) {
  TestWorld world(many_boxes(15), test_fleet(4), "patrol", 140.0);
  world.run(140.0);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.4);
  EXPECT_GT(world.coverage(), 0.3);
}

/// One box around the whole site, as in the contest of 2024. The planner learns only from its map where in the box the
/// structure is.
TEST(Patrol, FindsTheStructureInABoxThatHoldsEverything) {
  TestScene scene = two_towers();
  scene.boxes = {make_box({16.0, 12.0, 16.0}, {64.0, 56.0, 33.0}, 0.2)};
  TestWorld world(scene, test_fleet(3), "patrol", 400.0);
  world.run(400.0);
  EXPECT_GT(world.coverage(), 0.6);
  EXPECT_GT(world.clearance(), kExplorerRadiusM + 0.5);
  EXPECT_GT(world.gap(), 0.3);
  EXPECT_LE(world.undelivered(), 6U) << "only captures of the last seconds are left";
}

/// A tower with a thin wall (the screen) in front of it, outside the tower's box. The wall stands where a UAV would fly
/// to photograph the strips of the tower's front.
TestScene tower_with_a_screen() {
  TestScene scene;
  scene.solids = {make_box({0.0, 12.0, 14.0}, {16.0, 8.0, 28.0}), make_box({0.0, 3.3, 9.0}, {16.0, 0.6, 18.0})};
  scene.boxes = {make_box({0.0, 12.0, 14.5}, {17.0, 9.0, 29.0})};
  return scene;
}

TEST(Patrol, OnlyTheMapKeepsItAwayFromAnObstacleOutsideTheBoxes) {
  TestWorld with_map(tower_with_a_screen(), {{"a", Role::explorer, {-10.0, -14.0}}}, "patrol", 120.0);
  with_map.run(120.0);
  EXPECT_GT(with_map.clearance(), kExplorerRadiusM + 0.4);
  TestWorld without(tower_with_a_screen(), {{"eye", Role::photographer, {-10.0, -14.0}}}, "patrol", 200.0);
  without.run(200.0);
  EXPECT_LT(without.clearance(), kPhotographerRadiusM) << "no UAV has a LiDAR: it flies into the screen";
}

}  // namespace
}  // namespace skein::agent
