#include "uav_agent/maps/map_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

#include "core/files/octree_bytes.hpp"
#include "uav_agent/testing/news_radio.hpp"

namespace skein::agent {
namespace {

using CubeNumber = std::tuple<int, int, int>;

/// All cubes that a tree contains.
std::map<CubeNumber, Space> cubes_in(const std::vector<std::uint8_t>& bytes) {
  std::map<CubeNumber, Space> cubes;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_TRUE(visit_octree(text, 1.0, [&](const KnownCube& leaf) {
    const int edge = static_cast<int>(std::lround(leaf.edge_m));
    const Eigen::Vector3i lowest = leaf.lowest_W.cast<int>();
    for (int i = 0; i < edge * edge * edge; ++i) {
      const bool fresh =
          cubes
              .emplace(CubeNumber(lowest.x() + i % edge, lowest.y() + i / edge % edge, lowest.z() + i / (edge * edge)),
                       leaf.occupied ? Space::occupied : Space::free)
              .second;
      EXPECT_TRUE(fresh);
    }
  }));
  return cubes;
}

/// All that a map knows.
std::map<CubeNumber, Space> cubes_of(const WorldMap& map) {
  std::map<CubeNumber, Space> cubes;
  WorldMap::Chunk known;
  for (const Eigen::Vector3i& region : map.regions()) {
    for (int i = 0; i < WorldMap::kRegionChunks; ++i) {
      const Eigen::Vector3i chunk = WorldMap::chunk_of(region, i);
      map.read(chunk, known);
      for (int j = 0; j < MapLevel::kCells; ++j) {
        const Eigen::Vector3i cube = 8 * chunk + Eigen::Vector3i(j % 8, j / 8 % 8, j / 64);
        const Space space = known[static_cast<std::size_t>(j)].space;
        if (space != Space::unknown) cubes[{cube.x(), cube.y(), cube.z()}] = space;
      }
    }
  }
  return cubes;
}

TEST(MapTree, EqualsTheMapAfterEachUpdate) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "map_tree", 0);
    WorldMap map(WorldMap::Config{});
    MapTree tree;
    EXPECT_FALSE(tree.update(map)) << "nothing is known";
    EXPECT_TRUE(tree.bytes().empty());
    for (int growth = 0; growth < 6; ++growth) {
      test::draw_space(map, random, {0.0, 0.0, 10.0}, 30.0, 40);
      if (growth == 3) map.vacate({0.0, 0.0, 10.0}, 12.0);
      ASSERT_TRUE(tree.update(map));
      EXPECT_EQ(cubes_in(tree.bytes()), cubes_of(map));
      EXPECT_FALSE(tree.update(map)) << "nothing has changed";
    }
    MapTree late;
    ASSERT_TRUE(late.update(map));
    EXPECT_EQ(late.bytes(), tree.bytes()) << "a tree that is made later is the same";
  }
}

}  // namespace
}  // namespace skein::agent
