// Properties that only `towers` has; scene_families_test.cpp tests those of all families.
#include "scenes/towers.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace skein::sim {
namespace {

TEST(Towers, NominalSceneHasSixBoxesOfTheBenchmarksKind) {
  const Scene scene = sampled(make_towers(0));
  ASSERT_EQ(scene.boxes.size(), 6u);
  EXPECT_EQ(scene.points.size(), 4000u);
  EXPECT_EQ(scene.boxes[0].name, "deck");
  EXPECT_EQ(scene.boxes[5].name, "kiosk");
}

TEST(Towers, IsOfTheBenchmarksSize) {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max()}) {
    const Scene scene = sampled(make_towers(seed));
    Eigen::AlignedBox3d extent;
    for (const auto& v : scene.mesh.vertices) extent.extend(Vector3d(v.cast<double>()));
    EXPECT_GT(extent.max().z(), 55.0);
    EXPECT_LT(extent.max().z(), 66.0);
    EXPECT_LT(extent.sizes().head<2>().maxCoeff(), 150.0);
    EXPECT_LT(scene.mesh.triangles.size(), 30000u);
  }
}

}  // namespace
}  // namespace skein::sim
