// MovingClearance returns what RayScene returns, for every path: near and far from structure, in small steps and in
// leaps.
#include "sight/moving_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kMostM = 25.0;

TEST(MovingClearance, EqualsTheClearanceOfRayScene) {
  for (std::uint64_t world = 0; world < 10; ++world) {
    const RayScene rays(test::random_triangles(200, world));
    RandomStream random(world, "moving_clearance_test", 0, 0);
    MovingClearance clearance(kMostM);
    Vector3d p = test::random_in_box(random, {-60.0, -60.0, -60.0}, {60.0, 60.0, 60.0});
    for (int i = 0; i < 500; ++i) {
      p = i % 50 == 0 ? test::random_in_box(random, {-60.0, -60.0, -60.0}, {60.0, 60.0, 60.0})
                      : Vector3d(p + random.uniform(0.0, 2.0) * test::random_unit(random));
      ASSERT_EQ(clearance.at(rays, p), std::min(kMostM, rays.clearance(p))) << world << " " << i;
    }
  }
}

TEST(MovingClearance, IsTheUpperLimitInAnEmptyWorld) {
  const RayScene rays{TriangleMesh()};
  MovingClearance clearance(kMostM);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(clearance.at(rays, {1.0 * i, 2.0, 3.0}), kMostM);
}

}  // namespace
}  // namespace skein::sim
