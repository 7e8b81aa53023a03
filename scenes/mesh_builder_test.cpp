// Every shape is closed, wound outwards, and as large as geometry says.
#include "scenes/mesh_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](int i) { return Vector3d(mesh.vertices[t[i]].cast<double>()); };
    sum += p(0).dot(p(1).cross(p(2))) / 6.0;
  }
  return sum;
}

/// Whether each edge is used once in either direction.
bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, uses] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (uses != 1 || back == edges.end()) return false;
  }
  return !edges.empty();
}

Isometry3d somewhere() {
  Isometry3d X = Isometry3d::Identity();
  X.translation() << 10, -20, 5;
  X.linear() = rotation_z(0.7) * rotation_y(-0.4);
  return X;
}

TEST(MeshBuilder, ABoxIsClosedAndHasItsVolume) {
  MeshBuilder builder;
  builder.add_box(somewhere(), {2, 3, 4});
  EXPECT_TRUE(is_closed(builder.mesh()));
  EXPECT_NEAR(volume(builder.mesh()), 24.0, 1e-3);
}

TEST(MeshBuilder, AChamferedPrismIsClosedAndHasItsVolume) {
  MeshBuilder builder;
  builder.add_prism(somewhere(), rectangle({1, 2}, {6, 4}, 0.5), -1.0, 2.0);
  EXPECT_TRUE(is_closed(builder.mesh()));
  EXPECT_NEAR(volume(builder.mesh()), 3.0 * (24.0 - 4 * 0.5 * 0.25), 1e-3);
}

TEST(MeshBuilder, CylindersAndMembersAreClosedAndHaveTheirVolumeInAnyDirection) {
  for (const Vector3d& way : {Vector3d(0, 0, 5), Vector3d(0, 0, -5), Vector3d(3, -4, 0), Vector3d(1, 2, 3)}) {
    MeshBuilder cylinder, member;
    cylinder.add_cylinder({1, 1, 1}, Vector3d(1, 1, 1) + way, 0.5, 64);
    member.add_member({1, 1, 1}, Vector3d(1, 1, 1) + way, 0.3);
    EXPECT_TRUE(is_closed(cylinder.mesh()));
    EXPECT_NEAR(volume(cylinder.mesh()) / way.norm(), std::numbers::pi * 0.25, 0.01);
    EXPECT_TRUE(is_closed(member.mesh()));
    EXPECT_NEAR(volume(member.mesh()) / way.norm(), 0.09, 1e-4);
  }
}

TEST(MeshBuilder, DomeIsHalfAnEllipsoid) {
  MeshBuilder builder;
  builder.add_dome(somewhere(), {3, 2, 4}, 0.0, 64, 32);
  EXPECT_TRUE(is_closed(builder.mesh()));
  EXPECT_NEAR(volume(builder.mesh()), 2.0 / 3.0 * std::numbers::pi * 24.0, 0.3);
}

TEST(MeshBuilder, SheetIsClosedAndAsThickAsItsGridsAreApart) {
  std::vector<Ring> front, back;
  for (int row = 0; row <= 8; ++row) {
    front.emplace_back();
    back.emplace_back();
    for (int column = 0; column <= 5; ++column) {
      const Vector3d p(column, row, 0.3 * row * row - 0.2 * column);
      front.back().push_back(somewhere() * p);
      back.back().push_back(somewhere() * Vector3d(p - Vector3d(0, 0, 0.5)));
    }
  }
  MeshBuilder builder;
  builder.add_sheet(front, back);
  EXPECT_TRUE(is_closed(builder.mesh()));
  EXPECT_NEAR(volume(builder.mesh()), 5.0 * 8.0 * 0.5, 1e-2);
  EXPECT_THROW(builder.add_sheet(front, std::vector<Ring>{front[0]}), std::invalid_argument);
  EXPECT_THROW(builder.add_sheet(std::vector<Ring>{front[0]}, std::vector<Ring>{back[0]}), std::invalid_argument);
}

TEST(MeshBuilder, BadLoftsAreRefused) {
  MeshBuilder builder;
  const Ring three(3, Vector3d::Zero()), four(4, Vector3d::Zero());
  EXPECT_THROW(builder.add_loft(std::vector<Ring>{three}), std::invalid_argument);
  EXPECT_THROW(builder.add_loft(std::vector<Ring>{three, four}), std::invalid_argument);
  EXPECT_THROW(builder.add_loft(std::vector<Ring>{Ring(2), Ring(2)}), std::invalid_argument);
}

TEST(MeshBuilder, EnclosingBoxTakesTheLaterPartOnly) {
  MeshBuilder builder;
  builder.add_box(Isometry3d::Identity(), {50, 50, 50});
  const std::size_t first = builder.mesh().vertices.size();
  builder.add_box(somewhere(), {2, 3, 4});
  const OrientedBox box = enclosing_box("part", builder.mesh(), first, somewhere().linear(), 0.5);
  EXPECT_TRUE(box.center.isApprox(somewhere().translation(), 1e-5));
  EXPECT_TRUE(box.size.isApprox(Vector3d(3, 4, 5), 1e-5));
}

}  // namespace
}  // namespace skein::sim
