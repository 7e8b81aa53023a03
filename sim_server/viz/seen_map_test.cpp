#include "sim_server/viz/seen_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "core/math/random_stream.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim::viz {
namespace {

std::array<long, 3> cell_of(const Eigen::Vector3f& p, double edge) {
  return {std::lround(std::floor(p.x() / edge)), std::lround(std::floor(p.y() / edge)),
          std::lround(std::floor(p.z() / edge))};
}

// The map has one point for each cell that was ever seen, namely one of the points seen there, and never changes it.
TEST(SeenMap, TheMapKeepsAPointForEachCell) {
  constexpr double kEdge = 0.5;
  RandomStream random(1, "seen", 0);
  SeenMap map(kEdge);
  std::set<std::array<long, 3>> cells;
  std::set<std::array<float, 3>> seen;
  for (int round = 0; round < 50; ++round) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 100; ++i) {
      points.push_back(test::random_in_box(random, {-4, -4, -4}, {4, 4, 4}).cast<float>());
      cells.insert(cell_of(points.back(), kEdge));
      seen.insert({points.back().x(), points.back().y(), points.back().z()});
    }
    const std::vector<Eigen::Vector3f> before = map.points();
    EXPECT_EQ(map.add(points), cells.size() > before.size());
    ASSERT_EQ(map.points().size(), cells.size());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), map.points().begin()));
    EXPECT_FALSE(map.add(points)) << "nothing new";
  }
  std::set<std::array<long, 3>> kept;
  for (const Eigen::Vector3f& p : map.points()) {
    EXPECT_TRUE(kept.insert(cell_of(p, kEdge)).second);
    EXPECT_TRUE(seen.contains({p.x(), p.y(), p.z()}));
  }
  EXPECT_EQ(kept, cells);
}

TEST(SeenMap, TheMapTellsFarCellsApart) {
  SeenMap map(0.5);
  std::vector<Eigen::Vector3f> corners;
  for (int bits = 0; bits < 8; ++bits) {
    corners.emplace_back(bits & 1 ? 400e3F : -400e3F, bits & 2 ? 400e3F : -400e3F, bits & 4 ? 400e3F : -400e3F);
  }
  map.add(corners);
  EXPECT_EQ(map.points().size(), corners.size());
}

}  // namespace
}  // namespace skein::sim::viz
