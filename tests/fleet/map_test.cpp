// The map from LiDAR prevents collisions: a podium that no bounding box contains is in the way of the UAVs.
#include "fleet_fixture.hpp"
#include "small_scene.hpp"

namespace skein::test {
namespace {

constexpr double kPodiumHeight = 5.5;

/// A block on a podium. The only box contains the block alone; the podium extends 8 m in front of the block's
/// front face, where a UAV would fly to photograph this face.
SmallScene hidden_podium() {
  SmallScene scene;
  const Block block = {{30.0, 0.0, 9.0}, {12.0, 30.0, 18.0}};
  const Block podium = {{20.0, 0.0, 0.5 * kPodiumHeight}, {8.0, 30.0, kPodiumHeight}};
  scene.blocks = {block, podium};
  scene.boxes = {block};
  for (double y = -14.0; y <= 14.0; y += 2.0) {
    for (double z = 6.5; z <= 17.0; z += 2.5) scene.points.push_back({24.0, y, z, -1.0, 0.0, 0.0});
  }
  scene.fleet =
      "  - {name: jurong, vehicle: explorer, start: [0, 9], start_yaw_deg: 0}\n"
      "  - {name: changi, vehicle: photographer, start: [0, -9], start_yaw_deg: 0}\n";
  scene.duration_s = 120.0;
  return scene;
}

using MapMatters = FleetTest;

TEST_F(MapMatters, PatrolKeepsAwayFromStructureOutsideAllBoxes) {
  const auto scenario = write_small_scene(folder(), hidden_podium());
  const Json with_map = run("with", {scenario, "--planner", "patrol", "--one-process"}).result();
  EXPECT_EQ(with_map["status"], "completed");
  EXPECT_TRUE(with_map["collisions"].empty()) << with_map["collisions"];
  EXPECT_GT(with_map["score"], 0.0) << "the UAVs have not photographed the front face above the podium";

  // For comparison, `waypoints` flies a path through the podium: it uses no map.
  const auto file = write("front.yaml",
                          "paths:\n  jurong:\n    - {position: [19, 9, 10]}\n    - {position: [19, 9, 4]}\n"
                          "    - {position: [19, -9, 4]}\n");
  const Json without = run("without", {scenario, "--planner", "waypoints:" + file.string(), "--one-process"}).result();
  ASSERT_FALSE(without["collisions"].empty());
  for (const Json& collision : without["collisions"]) {
    EXPECT_EQ(collision["with"], "structure");
    EXPECT_LT(collision["position"][2], kPodiumHeight + 0.5) << "the collision is not with the podium";
  }
  EXPECT_GT(with_map["score"], without["score"]);
}

}  // namespace
}  // namespace skein::test
