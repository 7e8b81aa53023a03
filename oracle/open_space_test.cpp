// Rooms, windows and halls: which space is connected to the sky.
#include "oracle/open_space.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

const Eigen::AlignedBox3d kHouse(Vector3d(-5.0, -5.0, 0.0), Vector3d(5.0, 5.0, 6.0));
const Vector3d kInside(0.3, 0.2, 2.5);

/// Four walls of 0.2 m and a roof, 10 x 10 x 6 m, on the ground. In the wall at x = 5 a window, as wide as high, whose
/// sill is at 2 m.   @param window  0: none.
TriangleMesh house(double window) {
  TriangleMesh mesh;
  test::add_box(mesh, {-4.9, 0.0, 3.0}, {0.2, 10.0, 6.0});
  for (const double y : {-4.9, 4.9}) test::add_box(mesh, {0.0, y, 3.0}, {10.0, 0.2, 6.0});
  test::add_box(mesh, {0.0, 0.0, 5.9}, {10.0, 10.0, 0.2});
  const double side = 0.5 * (10.0 - window);
  for (const double y : {-0.5 * (window + side), 0.5 * (window + side)}) {
    test::add_box(mesh, {4.9, y, 3.0}, {0.2, side, 6.0});
  }
  if (window > 0.0) {
    test::add_box(mesh, {4.9, 0.0, 1.0}, {0.2, window, 2.0});
    test::add_box(mesh, {4.9, 0.0, 0.5 * (8.0 + window)}, {0.2, window, 4.0 - window});
  }
  return mesh;
}

TEST(OpenSpace, AClosedHouseIsNotReachedButAllAroundItIs) {
  const RayScene world(house(0.0));
  for (const double clearance : {0.0, 0.1, 0.5, 1.0}) {
    const OpenSpace space(world, kHouse, clearance, {});
    EXPECT_FALSE(space.reaches(kInside)) << clearance;
    for (const Vector3d& outside :
         {Vector3d(0, 0, 8.5), Vector3d(7.5, 0, 1), Vector3d(-8, -8, 0.1), Vector3d(0, 70, 3)}) {
      EXPECT_TRUE(space.reaches(outside)) << clearance << ": " << outside.transpose();
    }
  }
}

TEST(OpenSpace, AWindowLetsInABodyThatFitsThrough) {
  for (const double window : {0.8, 2.0, 3.0}) {
    const RayScene world(house(window));
    for (const double clearance : {0.1, 0.25, 0.5, 1.0, 1.2, 2.0}) {
      const OpenSpace space(world, kHouse, clearance, {});
      // For widths between these, it depends on the grid whether one of its lines runs through the window.
      const bool too_small = (window < 2.0 * clearance), large = (window > 2.0 * clearance + 1.5 * space.step());
      EXPECT_FALSE(too_small && space.reaches(kInside)) << window << ' ' << clearance;
      EXPECT_TRUE(!large || space.reaches(kInside)) << window << ' ' << clearance;
    }
  }
}

TEST(OpenSpace, AStartInAClosedHallOpensTheHall) {
  const RayScene world(house(0.0));
  const std::vector<Vector3d> starts = {{-2.0, 1.0, 0.1}};
  EXPECT_TRUE(OpenSpace(world, kHouse, 0.5, starts).reaches(kInside));
  const std::vector<Vector3d> elsewhere = {{-20.0, 1.0, 0.1}};
  EXPECT_FALSE(OpenSpace(world, kHouse, 0.5, elsewhere).reaches(kInside));
}

TEST(OpenSpace, TheAnswerDoesNotDependOnTheNumberOfThreads) {
  const RayScene world(test::random_triangles(300, 5));
  const Eigen::AlignedBox3d box(Vector3d(-20.0, -20.0, 0.0), Vector3d(20.0, 20.0, 20.0));
  const OpenSpace one(world, box, 0.5, {}), three(world, box, 0.5, {}, 3);
  RandomStream random(1, "open_space_test", 0);
  int reached = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = test::random_in_box(random, box.min(), box.max());
    EXPECT_EQ(one.reaches(p), three.reaches(p));
    reached += one.reaches(p) ? 1 : 0;
  }
  EXPECT_GT(reached, 100);
}

TEST(OpenSpace, AnEmptyWorldIsOpenAndAHugeOneNeedsFewLines) {
  const RayScene world(TriangleMesh{});
  const OpenSpace space(world, Eigen::AlignedBox3d(Vector3d::Zero()), 0.5, {});
  EXPECT_TRUE(space.reaches({0.0, 0.0, 0.5}));
  EXPECT_LE(OpenSpace::line_count({Vector3d(-5e4, -5e4, 0.0), Vector3d(5e4, 5e4, 1e3)}, 0.5), 1'200'000u);
}

}  // namespace
}  // namespace skein::sim
