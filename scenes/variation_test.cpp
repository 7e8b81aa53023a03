// Varied boxes of a family contain every place that was in a box before.
#include "scenes/variation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/euler.hpp"
#include "core/scenario/scene_families.hpp"

namespace skein::sim {
namespace {

Scene two_boxes() {
  OrientedBox a, b;
  a.name = "a";
  a.center = {10, 0, 5};
  a.size = {40, 6, 10};
  a.R_WO = rotation_z(0.4);
  b.name = "b";
  b.center = {-30, 20, 8};
  b.size = {5, 8, 16};
  Scene scene;
  scene.boxes = {a, b};
  return scene;
}

TEST(VaryBoxes, SeedZeroKeepsTheBoxes) {
  Scene scene = two_boxes();
  vary_boxes(scene, 0);
  const Scene before = two_boxes();
  ASSERT_EQ(scene.boxes.size(), before.boxes.size());
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    EXPECT_EQ(scene.boxes[i].name, before.boxes[i].name);
    EXPECT_EQ(scene.boxes[i].center, before.boxes[i].center) << i;
    EXPECT_EQ(scene.boxes[i].size, before.boxes[i].size) << i;
    EXPECT_EQ(scene.boxes[i].R_WO, before.boxes[i].R_WO) << i;
  }
}

TEST(VaryBoxes, APlaceInsideOfABoxStaysInside) {
  const Scene before = two_boxes();
  for (std::uint64_t seed = 1; seed < 200; ++seed) {
    Scene after = before;
    vary_boxes(after, seed);
    for (const OrientedBox& box : before.boxes) {
      for (double x = -0.5; x <= 0.5; x += 0.125) {
        for (const Vector2d& yz : {Vector2d(-0.5, -0.5), Vector2d(0.5, -0.5), Vector2d(0.5, 0.5), Vector2d(0, 0)}) {
          const Vector3d p = box.center + box.R_WO * Vector3d(x, yz.x(), yz.y()).cwiseProduct(box.size);
          EXPECT_TRUE(std::ranges::any_of(after.boxes, [&](const auto& b) { return b.contains(p, 1e-9); })) << seed;
        }
      }
    }
    for (const OrientedBox& box : after.boxes) {
      EXPECT_TRUE((box.R_WO.transpose() * box.R_WO).isIdentity(1e-12));
      EXPECT_NEAR(box.R_WO(2, 2), 1.0, 1e-12) << "boxes stand upright";
    }
  }
}

TEST(VaryBoxes, VariedSeedsHaveSomeLooseAndSomeIdleBoxes) {
  int idle = 0;
  std::vector<double> volumes;
  for (std::uint64_t seed = kVariedSeeds; seed < kVariedSeeds + 200; ++seed) {
    Scene scene = two_boxes();
    vary_boxes(scene, seed);
    idle += scene.boxes.back().name == "idle";
    volumes.push_back(scene.boxes.front().size.prod());
  }
  EXPECT_NEAR(idle, 60, 25);
  std::ranges::sort(volumes);
  EXPECT_GT(volumes[190], 2.0 * volumes[40]);
}

TEST(VaryBoxes, AboutOneSeedInFourHasASingleBox) {
  int single = 0, more = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Scene scene = two_boxes();
    vary_boxes(scene, seed);
    single += scene.boxes.size() == 1 && scene.boxes[0].name == "site";
    more += scene.boxes.size() > 2;
  }
  EXPECT_NEAR(single, 100, 30);
  EXPECT_GT(more, 30);
}

}  // namespace
}  // namespace skein::sim
