// The directions are evenly spread, and the search finds viewpoints that are hard to find.
#include "oracle/view_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

std::vector<Viewer> a_camera(double clearance, double desired = 2.0) {
  const CameraKind kind;
  return {{BestAim(kind, desired, RulesConfig{}), CameraMount(kind, true), clearance, {}}};
}

TEST(SphereDirection, CoversTheSphereEvenlyAtEveryLength) {
  RandomStream random(1, "view_search_test", 0);
  for (const std::size_t count : {64u, 100u, 256u, 1000u}) {
    double widest = 0.0;
    for (int i = 0; i < 500; ++i) {
      const Vector3d target = test::random_unit(random);
      double nearest = 2.0;
      for (std::size_t n = 0; n < count; ++n) nearest = std::min(nearest, (sphere_direction(n) - target).norm());
      widest = std::max(widest, nearest);
    }
    EXPECT_LT(widest, 4.0 / std::sqrt(static_cast<double>(count))) << count;
  }
  for (std::size_t n = 0; n < 1000; ++n) EXPECT_NEAR(sphere_direction(n).norm(), 1.0, 1e-12);
}

/// A plate at x = 4 with a square hole hides a wall at x = 5 from everything that keeps its distance.
TEST(ViewSearch, FindsASmallHole) {
  for (const double hole : {0.4, 0.8}) {
    TriangleMesh mesh;
    test::add_box(mesh, {5.5, 0.0, 30.0}, {1.0, 60.0, 60.0});
    const double side = 0.5 * (60.0 - hole);
    for (const double sign : {-1.0, 1.0}) {
      test::add_box(mesh, {4.0, sign * 0.5 * (hole + side), 30.0}, {0.02, side, 60.0});
      test::add_box(mesh, {4.0, 0.0, 30.0 + sign * 0.5 * (hole + side)}, {0.02, hole, side});
    }
    const RayScene world(mesh);
    const std::vector<Viewer> cameras = a_camera(0.6);
    const ViewSearch search(world, cameras, Berth::camera, RulesConfig{});
    int found = 0;
    for (const double y : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
      const InterestPoint point{{5.0F, static_cast<float>(y), 30.0F}, {-1.0F, 0.0F, 0.0F}};
      const ViewSearch::Found view = search.find(point, 128, {});
      EXPECT_GE(view.fine.q, view.coarse.q);
      if (view.fine.q <= 0.0) continue;
      ++found;
      // It looks through the hole, from the other side of the plate.
      EXPECT_LE(view.fine.p_WC.x(), 3.6);
      const double at_plate = 1.0 / (5.0 - view.fine.p_WC.x());
      EXPECT_LE(std::abs(y + at_plate * (view.fine.p_WC.y() - y)), 0.5 * hole + 0.01);
    }
    EXPECT_EQ(found, 5) << hole;
  }
}

TEST(ViewSearch, AViewThatIsGoodEnoughEndsTheSearch) {
  TriangleMesh mesh;
  test::add_box(mesh, {5.5, 0.0, 10.0}, {1.0, 20.0, 18.0});
  const RayScene world(mesh);
  // The points are so far away that few views are perfect; along their normals, the distance is even greater.
  const std::vector<Viewer> cameras = a_camera(6.0, 1.0);
  const ViewSearch search(world, cameras, Berth::camera, RulesConfig{});
  double best = 0.0, enough = 0.0;
  for (const float tilt : {0.2F, 0.4F, 0.6F, 0.8F}) {
    const InterestPoint point{{5.0F, 0.0F, 10.0F}, {-std::cos(tilt), std::sin(tilt), 0.0F}};
    const double ended = search.find(point, 64, {}, 0.2).fine.q;
    EXPECT_GE(ended, 0.2);
    enough += ended;
    best += search.find(point, 64, {}).fine.q;
  }
  EXPECT_LT(enough, best);
}

/// The estimate must not contain pictures that the referee would refuse.
TEST(ViewSearch, FindsOnlyWhatTheRefereeSeesByTheRulesOfTheRun) {
  std::mt19937_64 random(7);
  const auto drawn = [&](float least, float most) {
    return least + (most - least) * static_cast<float>(random() % 1000) / 1000.0F;
  };
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    test::add_box(mesh, {drawn(-20.0F, 20.0F), drawn(-20.0F, 20.0F), drawn(2.0F, 15.0F)},
                  {drawn(1.0F, 4.0F), drawn(1.0F, 4.0F), drawn(1.0F, 4.0F)});
  }
  const RayScene world(mesh);
  const std::vector<Viewer> cameras = a_camera(0.5);
  for (const RulesConfig& rules : rules_presets()) {
    const ViewSearch search(world, cameras, Berth::camera, rules);
    int found = 0, asked = 0;
    for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
      const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])]; };
      const float a = drawn(0.1F, 0.5F), b = drawn(0.1F, 0.4F);
      const Eigen::Vector3f u = corner(1) - corner(0), v = corner(2) - corner(0);
      const InterestPoint point{corner(0) + a * u + b * v, u.cross(v).normalized()};
      const PointView best = search.find(point, 64, {}).fine;
      ++asked;
      if (best.q <= 0.0) continue;
      ++found;
      EXPECT_TRUE(sight_test(rules)(best.p_WC, point.p_W.cast<double>(), kNoUav, world))
          << rules.preset << ", triangle " << triangle;
    }
    EXPECT_GT(found, asked / 3) << rules.preset;
  }
}

TEST(ViewSearch, TheSearchKeepsViewsThatAreKnownBefore) {
  const RayScene world(TriangleMesh{});
  const std::vector<Viewer> cameras = a_camera(0.5);
  const ViewSearch search(world, cameras, Berth::camera, RulesConfig{});
  const InterestPoint in_the_air{{0.0F, 0.0F, 10.0F}, {1.0F, 0.0F, 0.0F}};  // on no surface: never seen
  EXPECT_EQ(search.find(in_the_air, 16, {}).fine.q, 0.0);
  const ViewSearch::Found known{{{1.0, 2.0, 3.0}, 0.1, 0.2, 0.5, 0.0, 0}, {{1.0, 2.0, 4.0}, 0.1, 0.2, 0.6, 0.0, 0}};
  EXPECT_EQ(search.find(in_the_air, 16, known).coarse.q, 0.5);
  EXPECT_EQ(search.find(in_the_air, 16, known).fine.p_WC, Vector3d(1.0, 2.0, 4.0));
}

}  // namespace
}  // namespace skein::sim
