// What every planner must do and must never do, whatever its strategy: all that are registered, by name, in a world
// without physics.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "uav_agent/planning/payload.hpp"
#include "uav_agent/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kTouchM = 0.63 + 0.3;             ///< to structure: the larger body, and a little
constexpr double kSmallestSeparationM = 2 * 0.63;  ///< between two of them

/// What to say to make a planner; those that need a file get one.
std::string spec_of(const std::string& name) {
  if (name != "waypoints") return name;
  const auto file = std::filesystem::path(testing::TempDir()) / "contract_paths.yaml";
  std::ofstream out(file);
  out << "paths:\n";
  for (int uav = 0; uav < 1; ++uav) out << "  uav" << uav << ":\n    - {position: [-8, -14, 6]}\n";
  return name + ":" + file.string();
}

class EveryPlanner : public testing::TestWithParam<std::string> {
 protected:
  TestWorld world(const TestScene& scene, std::size_t uavs, double duration_s) const {
    return {scene, test_fleet(uavs), spec_of(GetParam()), duration_s};
  }
  static void expect_sound(const TestWorld& world) {
    EXPECT_EQ(world.bad_commands(), 0U);
    EXPECT_GT(world.clearance(), kTouchM);
    EXPECT_GT(world.separation(), kSmallestSeparationM);
    EXPECT_LE(world.longest_message(), 2 * kMaxPayloadBytes);
  }
};

TestScene many_boxes(int count) {
  TestScene scene;
  for (int i = 0; i < count; ++i) {
    const Vector3d centre(14.0 * (i % 5), 14.0 * (i / 5), 6.0 + i % 4);
    scene.solids.push_back(make_box(centre, {4.0, 4.0, 2.0 * centre.z()}, 0.2 * i));
    scene.boxes.push_back(make_box(centre + Vector3d(0.0, 0.0, 0.5), {5.0, 5.0, 2.0 * centre.z() + 1.0}, 0.2 * i));
  }
  return scene;
}

TEST_P(EveryPlanner, SameInputSameOutput) {
  TestWorld once = world(two_towers(), 3, 90.0), again = world(two_towers(), 3, 90.0);
  once.run(90.0);
  again.run(90.0);
  EXPECT_EQ(once.fingerprint(), again.fingerprint());
}

TEST_P(EveryPlanner, OneUavAlone) {
  TestWorld alone = world(two_towers(), 1, 120.0);
  alone.run(120.0);
  expect_sound(alone);
  EXPECT_GT(alone.highest_m(0), 1.5) << "it flies";
}

TEST_P(EveryPlanner, EightUavs) {
  TestWorld eight = world(two_towers(), 8, 100.0);
  eight.run(100.0);
  expect_sound(eight);
}

TEST_P(EveryPlanner, OneBox) {
  TestWorld one = world(many_boxes(1), 3, 90.0);
  one.run(90.0);
  expect_sound(one);
}

TEST_P(EveryPlanner, FifteenBoxes) {
  TestWorld fifteen = world(many_boxes(15), 4, 100.0);
  fifteen.run(100.0);
  expect_sound(fifteen);
}

TEST_P(EveryPlanner, PeersThatNeverSayAWord) {
  TestScene scene = two_towers();
  scene.talk = false;
  TestWorld silent = world(scene, 4, 120.0);
  silent.run(120.0);
  expect_sound(silent);
}

/// Nobody sees anybody: each far from the others, since nobody could give way.
TEST_P(EveryPlanner, NoRadioAtAll) {
  TestScene scene = two_towers();
  scene.radio = false;
  TestWorld dark = world(scene, 1, 120.0);
  dark.run(120.0);
  expect_sound(dark);
}

TEST_P(EveryPlanner, AnEmptyMapAndNoBoxes) {
  TestScene scene;
  TestWorld empty = world(scene, 2, 60.0);
  empty.run(60.0);
  expect_sound(empty);
}

TEST_P(EveryPlanner, ItsOwnRestartInFlight) {
  TestWorld restarted = world(two_towers(), 3, 150.0);
  restarted.run(70.0);
  restarted.restart(0);
  restarted.run(20.0);
  restarted.restart(1);
  restarted.run(60.0);
  expect_sound(restarted);
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlanner, testing::ValuesIn(planner_names()),
                         [](const auto& planner) { return planner.param; });

}  // namespace
}  // namespace skein::agent
