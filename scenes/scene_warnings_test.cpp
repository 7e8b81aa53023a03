#include "scenes/scene_warnings.hpp"

#include <gtest/gtest.h>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

Scene scene_with(std::vector<Eigen::Vector3f> positions) {
  Scene scene;
  scene.boxes = {{"low", {0, 0, 1}, {4, 2, 2}, rotation_z(0.5)}, {"high", {0, 0, 11}, {2, 2, 2}, Matrix3d::Identity()}};
  for (const auto& p : positions) scene.points.push_back({p, {0, 0, 1}});
  return scene;
}

TEST(SceneWarnings, ThereIsNoneWhenEveryPointIsInABox) {
  const Eigen::Vector3f corner = (rotation_z(0.5) * Vector3d(1.99, 0.99, 0.0)).cast<float>();
  EXPECT_TRUE(scene_warnings(scene_with({{0, 0, 0}, {corner.x(), corner.y(), 1}, {1, 1, 12}})).empty());
}

TEST(SceneWarnings, CountsPointsOutsideAndNamesTheFirst) {
  const auto warnings = scene_warnings(scene_with({{0, 0, 1}, {0, 0, 5.5F}, {1, 1, 12}, {50, 0, 1}}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "2 of 4 interest points lie outside every box, the first is point 1 at (0.00, 0.00, 5.50)");
}

}  // namespace
}  // namespace skein::sim
