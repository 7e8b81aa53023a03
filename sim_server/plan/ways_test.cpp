// Paths around obstacles keep their clearance, in both directions.
#include "sim_server/plan/ways.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kClear = 1.0;

/// Two walls with a passage three metres wide between them, and a room without an opening.
TriangleMesh walls() {
  TriangleMesh mesh;
  test::add_box(mesh, {0.0, -11.5, 10.0}, {0.4, 20.0, 20.0});
  test::add_box(mesh, {0.0, 11.5, 10.0}, {0.4, 20.0, 20.0});
  for (const double side : {-1.0, 1.0}) {
    test::add_box(mesh, {12.0 + 4.0 * side, 0.0, 6.0}, {0.2, 8.0, 8.0});
    test::add_box(mesh, {12.0, 4.0 * side, 6.0}, {8.0, 0.2, 8.0});
    test::add_box(mesh, {12.0, 0.0, 6.0 + 4.0 * side}, {8.0, 8.0, 0.2});
  }
  return mesh;
}

class WaysAroundWalls : public ::testing::Test {
 protected:
  RayScene world_{walls()};
  Ways ways_{world_, {Vector3d(-20.0, -30.0, 1.5), Vector3d(24.0, 30.0, 26.0)}, kClear, 1500};

  std::vector<Vector3d> way(const Vector3d& a_W, const Vector3d& b_W) {
    return ways_.way(a_W, ways_.anchors(a_W), b_W, ways_.anchors(b_W));
  }
  double least_room(const Vector3d& a_W, const Vector3d& b_W) const {
    double least = 1e9;
    for (double part = 0.0; part <= 1.0; part += 0.002) {
      least = std::min(least, world_.clearance(a_W + part * (b_W - a_W)));
    }
    return least;
  }
};

TEST_F(WaysAroundWalls, EveryLegKeepsTheClearance) {
  RandomStream random(1, "ways_test", std::uint64_t{0});
  int detours = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d a_W = test::random_in_box(random, {-18.0, -20.0, 2.0}, {-2.0, 20.0, 18.0});
    const Vector3d b_W = test::random_in_box(random, {1.5, -20.0, 2.0}, {6.5, 20.0, 18.0});
    const std::vector<Vector3d> corners = way(a_W, b_W);
    ASSERT_FALSE(corners.empty()) << i;
    EXPECT_EQ(corners.back(), b_W);
    detours += corners.size() > 1 ? 1 : 0;
    Vector3d at = a_W;
    for (const Vector3d& corner : corners) {
      ASSERT_GE(least_room(at, corner), kClear - Ways::kSlack - 1e-9) << i;
      at = corner;
    }
  }
  EXPECT_GT(detours, 100);
}

TEST_F(WaysAroundWalls, ALineIsClearIfItKeepsTheClearance) {
  RandomStream random(2, "ways_test", std::uint64_t{0});
  int clear = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d a_W = test::random_in_box(random, {-8.0, -20.0, 2.0}, {8.0, 20.0, 18.0});
    const Vector3d b_W = a_W + test::random_in_box(random, {-6.0, -6.0, -1.0}, {6.0, 6.0, 6.0});
    const double room = least_room(a_W, b_W);
    const bool is_clear = ways_.clear(a_W, b_W);
    clear += is_clear ? 1 : 0;
    EXPECT_TRUE(!is_clear || room >= kClear - Ways::kSlack - 1e-9) << room;
    EXPECT_TRUE(is_clear || room < kClear) << room;
  }
  EXPECT_GT(clear, 100);
  EXPECT_LT(clear, 900);
}

TEST_F(WaysAroundWalls, NoPathLeadsIntoAClosedRoom) { EXPECT_TRUE(way({-5.0, 0.0, 6.0}, {12.0, 0.0, 6.0}).empty()); }

}  // namespace
}  // namespace skein::sim
