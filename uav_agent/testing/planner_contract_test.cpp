// The rules that every planner must keep, whatever its strategy. Tests all registered planners, in a world without
// physics.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/math/random_stream.hpp"
#include "core/planners/hand_file.hpp"
#include "uav_agent/api/payload.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

constexpr double kTouchM = kExplorerRadiusM + 0.3;  ///< to structure: the larger body, and a little
constexpr double kSmallestGapM = 0.3;               ///< between two bodies
constexpr double kUnmeasuredM = 1e3;                ///< a distance that no UAV flew in

/// A file of drawn commands: up, and then anything.
std::string drawn_hand_commands() {
  const auto file = std::filesystem::path(testing::TempDir()) / "drawn_hand_commands.csv";
  std::ofstream out(file);
  RandomStream random(5, "hands of anybody", 0);
  out << hand_file::head() << hand_file::line_of({20, 400, {.velocity = {0.0, 0.0, 2.0}}});
  for (std::uint64_t k = 160; k < 3000; k += 10 + random.bits() % 100) {
    const auto speed = [&] { return random.uniform(-4.0, 4.0); };
    out << hand_file::line_of(
        {k, static_cast<Tick>(20 * k), {{speed(), speed(), 0.3 * speed()}, random.uniform(-1, 1)}});
  }
  return file.string();
}

/// The value of --planner for a planner. One that needs a file gets a file with a place above the start of every UAV.
std::string spec_of(const std::string& name, const std::vector<TestUav>& fleet) {
  if (name == kHandPlanner) return name + ":" + drawn_hand_commands();
  if (name != "waypoints") return name;
  const auto file = std::filesystem::path(testing::TempDir()) / ("paths_of_" + std::to_string(fleet.size()) + ".yaml");
  std::ofstream out(file);
  out << "paths:\n";
  for (const TestUav& uav : fleet) {
    out << "  " << uav.name << ":\n    - {position: [" << uav.start.x() << ", " << uav.start.y() << ", 6]}\n";
  }
  return name + ":" + file.string();
}

class EveryPlanner : public testing::TestWithParam<std::string> {
 protected:
  TestWorld world(const TestScene& scene, std::size_t uavs, double duration_s) const {
    const auto fleet = test_fleet(uavs);
    return {scene, fleet, spec_of(GetParam(), fleet), duration_s};
  }
  static void expect_sound(const TestWorld& world) {
    EXPECT_EQ(world.bad_commands(), 0U);
    EXPECT_EQ(world.doubtful_scans(), 0U);
    EXPECT_GT(world.clearance(), kTouchM);
    EXPECT_GT(world.gap(), kSmallestGapM);
    EXPECT_LE(world.longest_message(), 2 * kMaxPayloadBytes);
  }
  /// If no UAV flew, keeping clear of everything would prove nothing.
  static void expect_all_flew(const TestWorld& world, std::size_t uavs) {
    if (GetParam() == "learner") {  // no program commands it here
      for (const UavIndex uav : FirstUavs(uavs)) EXPECT_LT(world.highest_m(uav), 1.0) << "uav" << uav;
      return;
    }
    for (const UavIndex uav : FirstUavs(uavs)) EXPECT_GT(world.highest_m(uav), 1.5) << "uav" << uav;
    EXPECT_LT(world.clearance(), kUnmeasuredM) << "no UAV came near structure";
    EXPECT_EQ(world.separation() < kUnmeasuredM, uavs > 1);
  }
};

TEST_P(EveryPlanner, GivesTheSameOutputsForTheSameInputs) {
  TestWorld once = world(two_towers(), 3, 90.0), again = world(two_towers(), 3, 90.0);
  once.run(90.0);
  again.run(90.0);
  EXPECT_EQ(once.fingerprint(), again.fingerprint());
}

TEST_P(EveryPlanner, KeepsTheRulesWithOneUav) {
  TestWorld alone = world(two_towers(), 1, 120.0);
  alone.run(120.0);
  expect_sound(alone);
  expect_all_flew(alone, 1);
}

TEST_P(EveryPlanner, KeepsTheRulesWithEightUavs) {
  TestWorld eight = world(two_towers(), 8, 100.0);
  eight.run(100.0);
  expect_sound(eight);
  expect_all_flew(eight, 8);
}

TEST_P(EveryPlanner, KeepsTheRulesWithOneBox) {
  TestWorld one = world(many_boxes(1), 3, 90.0);
  one.run(90.0);
  expect_sound(one);
  expect_all_flew(one, 3);
}

TEST_P(EveryPlanner, KeepsTheRulesWithFifteenBoxes) {
  TestWorld fifteen = world(many_boxes(15), 4, 100.0);
  fifteen.run(100.0);
  expect_sound(fifteen);
  expect_all_flew(fifteen, 4);
}

TEST_P(EveryPlanner, KeepsTheRulesIfNoMessagesArrive) {
  TestScene scene = two_towers();
  scene.talk = false;
  TestWorld silent = world(scene, 4, 120.0);
  silent.run(120.0);
  expect_sound(silent);
  expect_all_flew(silent, 4);
}

/// No UAV sees another one, so none can give way. All other rules hold.
TEST_P(EveryPlanner, KeepsTheRulesWithoutRadio) {
  TestScene scene = two_towers();
  scene.radio = false;
  TestWorld dark = world(scene, 3, 120.0);
  dark.run(120.0);
  EXPECT_EQ(dark.bad_commands(), 0U);
  EXPECT_GT(dark.clearance(), kTouchM);
  expect_all_flew(dark, 3);
}

/// The UAVs can hit only each other, and have nothing to look at. They stay near their starts.
TEST_P(EveryPlanner, KeepsTheRulesWithAnEmptyMapAndNoBoxes) {
  TestWorld empty = world(TestScene(), 2, 60.0);
  empty.run(60.0);
  expect_sound(empty);
  EXPECT_EQ(empty.clearance(), 1e9) << "there is no structure";
  for (const UavIndex uav : FirstUavs(2)) {
    EXPECT_GE(empty.position(uav).z(), 0.0);
    EXPECT_LT((empty.position(uav).head<2>() - test_fleet(2)[uav].start).norm(), 60.0);
    EXPECT_LT(empty.highest_m(uav), 60.0);
  }
}

TEST_P(EveryPlanner, KeepsTheRulesWhenItIsRestartedInFlight) {
  TestWorld restarted = world(two_towers(), 3, 150.0);
  restarted.run(70.0);
  restarted.restart(0);
  restarted.run(20.0);
  restarted.restart(1);
  restarted.run(60.0);
  expect_sound(restarted);
  expect_all_flew(restarted, 3);
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlanner, testing::ValuesIn(planner_names()),
                         [](const auto& planner) { return planner.param; });

}  // namespace
}  // namespace skein::agent
