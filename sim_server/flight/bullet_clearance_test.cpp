#include "sim_server/flight/bullet_clearance.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

TEST(BulletClearance, DistanceToATriangleAgreesWithBruteForce) {
  RandomStream random(5, "clearance", 0);
  for (int i = 0; i < 3000; ++i) {
    const Vector3d low(-5, -5, -5), high(5, 5, 5);
    TriangleMesh mesh;
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(test::random_in_box(random, low, high).cast<float>());
    mesh.triangles = {{0, 1, 2}};
    const Vector3d p = test::random_in_box(random, 2.0 * low, 2.0 * high);
    const auto corner = [&](std::size_t k) { return mesh.vertices[k].cast<double>().eval(); };
    EXPECT_NEAR(distance_to_triangle(p, corner(0), corner(1), corner(2)), test::brute_force_clearance(mesh, p), 1e-6);
  }
}

TEST(BulletClearance, TrianglesWithoutAreaAreEdgesOrPoints) {
  EXPECT_DOUBLE_EQ(distance_to_triangle({0, 0, 3}, {-1, 0, 0}, {1, 0, 0}, {2, 0, 0}), 3.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({5, 0, 4}, {-1, 0, 0}, {1, 0, 0}, {2, 0, 0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 1, 3}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 2.0);
}

}  // namespace
}  // namespace skein::sim
