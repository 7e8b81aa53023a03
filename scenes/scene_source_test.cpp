// Tests of the scene that load_scene() returns for a scenario.
#include "scenes/scene_source.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/scenario/scene_families.hpp"

namespace skein::sim {
namespace {

TEST(SceneSource, EveryFamilyIsBuilt) {
  for (const auto& family : scene_families()) {
    Scenario scenario;
    scenario.scene.family = family.name;
    const Scene scene = load_scene(scenario);
    EXPECT_FALSE(scene.mesh.triangles.empty()) << family.name;
    EXPECT_FALSE(scene.points.empty()) << family.name;
    EXPECT_FALSE(scene.boxes.empty()) << family.name;
  }
}

TEST(SceneSource, TheErrorForAnUnknownFamilyListsTheKnownOnes) {
  Scenario scenario;
  scenario.scene.family = "tower";
  try {
    load_scene(scenario);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("towers"), std::string::npos) << error.what();
  }
}

TEST(SceneSource, TheBenchmarksFilesAreLoaded) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (!assets) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const auto folder = std::filesystem::path(assets) / "models" / "crane";
  Scenario scenario;
  scenario.scene.meshes = {folder / "construction_crane_1.stl", folder / "construction_crane_2.stl"};
  scenario.scene.points = folder / "crane_interest_points_on_meshes.pcd";
  scenario.scene.boxes = folder / "bounding_boxes" / "box_description.yaml";
  const Scene scene = load_scene(scenario);
  EXPECT_EQ(scene.points.size(), 1481u);
  EXPECT_EQ(scene.boxes.size(), 15u);
  for (const auto& t : scene.mesh.triangles) {
    for (const auto v : t) ASSERT_LT(v, scene.mesh.vertices.size());
  }

  // The second mesh follows the first one, and its triangles refer to its own vertices.
  scenario.scene.meshes.pop_back();
  const Scene first = load_scene(scenario);
  ASSERT_LT(first.mesh.triangles.size(), scene.mesh.triangles.size());
  EXPECT_EQ(scene.mesh.triangles[first.mesh.triangles.size()][0], first.mesh.vertices.size());
}

}  // namespace
}  // namespace skein::sim
