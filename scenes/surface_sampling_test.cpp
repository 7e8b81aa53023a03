// Interest points: where they lie, how evenly, and where there are none.
#include "scenes/surface_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scenes/mesh_builder.hpp"

namespace skein::sim {
namespace {

Isometry3d at(double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); }

OrientedBox box_around(const Vector3d& center, double edge) {
  OrientedBox box;
  box.center = center;
  box.size = Vector3d::Constant(edge);
  return box;
}

/// A cube of 10 m that hovers; 600 m^2.
TriangleMesh cube() {
  MeshBuilder builder;
  builder.add_box(at(0, 0, 20), {10, 10, 10});
  return builder.take();
}

TEST(SurfaceSampling, PointsLieOnTheSurfaceWithItsNormal) {
  const std::vector boxes{box_around({0, 0, 20}, 11)};
  const auto points = sample_surface(cube(), boxes, 600, 1);
  ASSERT_EQ(points.size(), 600u);
  for (const auto& point : points) {
    const Vector3d p = point.p_W.cast<double>() - Vector3d(0, 0, 20), n = point.n_W.cast<double>();
    EXPECT_NEAR(p.cwiseAbs().maxCoeff(), 5.0, 1e-5);
    EXPECT_NEAR(p.dot(n), 5.0, 1e-5);
    EXPECT_NEAR(n.norm(), 1.0, 1e-6);
  }
}

TEST(SurfaceSampling, PointsAreSpreadEvenly) {
  const std::vector boxes{box_around({0, 0, 20}, 11)};
  const auto points = sample_surface(cube(), boxes, 600, 1);  // mean spacing 1 m
  std::array<int, 6> on_face{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Index axis = 0;
    const float sign = points[i].n_W.cwiseAbs().maxCoeff(&axis) > 0 ? points[i].n_W[axis] : 0.0f;
    ++on_face[static_cast<std::size_t>(2 * axis + (sign > 0))];
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((points[i].p_W - points[j].p_W).norm(), 0.5f);
  }
  for (const int count : on_face) EXPECT_NEAR(count, 100, 15);
}

TEST(SurfaceSampling, PointsLieOnlyInsideTheBoxes) {
  const std::vector boxes{box_around({5, 0, 20}, 4)};
  const auto points = sample_surface(cube(), boxes, 50, 1);
  EXPECT_EQ(points.size(), 50u);
  for (const auto& point : points) EXPECT_TRUE(boxes[0].contains(point.p_W.cast<double>()));
}

TEST(SurfaceSampling, NoPointLiesWhereSolidsOverlapTouchOrStandOnTheGround) {
  MeshBuilder builder;
  builder.add_box(at(0, 0, 5), {10, 10, 10});      // on the ground
  builder.add_box(at(4, 0, 8), {10, 4, 4});        // half inside the first
  builder.add_box(at(0, 7.5, 5), {10, 5, 10});     // touches it
  builder.add_box(at(0, -5.65, 5), {10, 0.7, 8});  // 0.3 m off its side
  const std::vector boxes{box_around({0, 0, 5}, 40)};
  const auto points = sample_surface(builder.mesh(), boxes, 800, 1);
  EXPECT_EQ(points.size(), 800u);
  for (const auto& point : points) {
    const Eigen::Vector3f& p = point.p_W;
    EXPECT_GE(p.z(), 0.3f);
    const auto strictly_inside = [&](const Vector3d& center, const Vector3d& size) {
      return ((p.cast<double>() - center).cwiseAbs().array() < (0.5 * size).array() - 1e-4).all();
    };
    EXPECT_FALSE(strictly_inside({0, 0, 5}, {10, 10, 10}));
    EXPECT_FALSE(strictly_inside({4, 0, 8}, {10, 4, 4}));
    const bool in_front_of_joint = std::abs(p.x()) < 5 && p.z() < 10;
    EXPECT_FALSE(in_front_of_joint && std::abs(p.y() - 5) < 1e-4) << "a point lies between touching solids";
    const bool behind_plate = std::abs(p.x()) < 4.9 && p.z() > 1.1 && p.z() < 8.9;
    EXPECT_FALSE(behind_plate && p.y() < -4.99 && p.y() > -5.31) << "a point lies in a gap of 0.3 m";
  }
}

TEST(SurfaceSampling, ThinMembersGetTheShareOfTheirArea) {
  MeshBuilder builder;
  builder.add_box(at(0, 0, 20), {10, 10, 10});  // 600 m^2
  for (int i = 0; i < 100; ++i) {
    builder.add_member({40, -30.0 + 2.0 * i / 3.0, 10}, {40, -30.0 + 2.0 * i / 3.0, 40}, 0.05);  // 6 m^2 each
  }
  const std::vector boxes{box_around({20, 0, 20}, 100)};
  const auto points = sample_surface(builder.mesh(), boxes, 2400, 1);
  EXPECT_EQ(points.size(), 2400u);
  const auto on_members = std::ranges::count_if(points, [](const auto& point) { return point.p_W.x() > 39; });
  EXPECT_NEAR(static_cast<double>(on_members), 1200.0, 60.0);
}

TEST(SurfaceSampling, BothSidesOfAThinPlateGetTheirShare) {
  MeshBuilder builder;
  builder.add_box(at(0, 0, 20), {10, 10, 0.02});
  builder.add_box(at(30, 0, 20), {10, 5, 5});
  const std::vector boxes{box_around({15, 0, 20}, 100)};
  const auto points = sample_surface(builder.mesh(), boxes, 450, 1);
  const auto on_plate = [&](float side) {
    return std::ranges::count_if(points, [&](const auto& p) { return p.p_W.x() < 15 && p.n_W.z() * side > 0.5f; });
  };
  EXPECT_NEAR(static_cast<double>(on_plate(1)), 100.0, 15.0);
  EXPECT_NEAR(static_cast<double>(on_plate(-1)), 100.0, 15.0);
}

TEST(SurfaceSampling, AThinMemberHidesWhatIsCloseBehindIt) {
  MeshBuilder builder;
  builder.add_box(at(0, 0, 20), {4, 4, 4});
  for (int i = 0; i <= 40; ++i) {  // a grate of bars 5 cm wide before the top
    builder.add_box(at(-2.0 + 0.1 * i, 0, 22.25), {0.05, 4, 0.05});
  }
  const std::vector boxes{box_around({0, 0, 20}, 4.001)};  // without the grate
  const auto points = sample_surface(builder.mesh(), boxes, 300, 1);
  for (const auto& point : points) {
    if (point.n_W.z() < 0.5f) continue;
    const double off = std::remainder(static_cast<double>(point.p_W.x()), 0.1);
    EXPECT_GT(std::abs(off), 0.0249) << "a point lies behind a bar: " << point.p_W.transpose();
  }
}

TEST(SurfaceSampling, TheSameSeedGivesTheSamePointsAndAnotherSeedOthers) {
  const std::vector boxes{box_around({0, 0, 20}, 11)};
  const auto bytes = [&](std::uint64_t seed) {
    const auto points = sample_surface(cube(), boxes, 100, seed);
    std::vector<char> all(points.size() * sizeof(InterestPoint));
    std::memcpy(all.data(), points.data(), all.size());
    return all;
  };
  EXPECT_EQ(bytes(1), bytes(1));
  EXPECT_NE(bytes(1), bytes(2));
}

TEST(SurfaceSampling, WithoutASurfaceThereAreNoPoints) {
  EXPECT_TRUE(sample_surface({}, std::vector{box_around({0, 0, 0}, 5)}, 10, 1).empty());
  EXPECT_TRUE(sample_surface(cube(), std::vector{box_around({99, 0, 0}, 5)}, 10, 1).empty());
}

}  // namespace
}  // namespace skein::sim
