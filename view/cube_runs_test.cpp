#include "view/cube_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "core/files/octree_bytes.hpp"
#include "process/json_text.hpp"
#include "view/testing/unpacked.hpp"

namespace skein::view {
namespace {

using Cube = std::tuple<int, int, int>;  // a cube's indices along z, y, x

std::set<Cube> cubes_of(const std::vector<CubeRun>& runs) {
  std::set<Cube> cubes;
  for (const CubeRun& run : runs) {
    for (int i = 0; i < run.length; ++i)
      EXPECT_TRUE(cubes.emplace(run.z, run.y, run.x + i).second) << "two runs contain the same cube";
  }
  return cubes;
}

int cell_of(double metres, double cell_m) { return static_cast<int>(std::floor(metres / cell_m)); }

/// Reference implementation, cube by cube: the cubes of 0.5 m that a tree's occupied (or else its free) leaves cover.
/// @param at_z  only the cubes with this index along z; nullopt: all.
std::set<Cube> cubes_of(std::string_view tree, bool occupied, const std::optional<int>& at_z) {
  std::set<Cube> cubes;
  visit_octree(tree, 0.5, [&](const KnownCube& leaf) {
    const int edge = static_cast<int>(std::lround(leaf.edge_m / 0.5));
    for (int i = 0; leaf.occupied == occupied && i < edge * edge * edge; ++i) {
      const int x = cell_of(leaf.lowest_W.x(), 0.5) + i % edge, y = cell_of(leaf.lowest_W.y(), 0.5) + i / edge % edge,
                z = cell_of(leaf.lowest_W.z(), 0.5) + i / (edge * edge);
      if (!at_z || z == *at_z) cubes.emplace(z, y, x);
    }
  });
  return cubes;
}

/// Random occupancy of 16 x 16 x 16 cubes around the origin, and its octree in OctoMap's binary serialisation.
class DrawnCubes {
 public:
  explicit DrawnCubes(std::mt19937& random) {
    cubes_.fill('\0');
    for (unsigned i = 1 + random() % 60; i > 0; --i) {
      const int edge = 1 << random() % 4, room = 16 - edge + 1;
      const auto along = [&] { return static_cast<int>(random() % static_cast<unsigned>(room)) / edge * edge; };
      const int x = along(), y = along(), z = along();
      const char kind = static_cast<char>(random() % 3);
      for (int j = 0; j < edge * edge * edge; ++j) at(x + j % edge, y + j / edge % edge, z + j / (edge * edge)) = kind;
    }
    write(0, {-(1 << 15), -(1 << 15), -(1 << 15)}, tree_);
  }
  const std::string& tree() const { return tree_; }

 private:
  using Key = std::array<int, 3>;
  char& at(int x, int y, int z) { return cubes_[static_cast<std::size_t>(x + 16 * (y + 16 * z))]; }
  /// Serialises a node: appends its bytes and those of all nodes below if it is an inner node, else nothing.
  /// @param depth  0: the root, 16: the smallest cubes. @param key  the node's lowest corner [smallest cubes].
  /// @returns the code of the node in its parent: 0: unknown, 1: free, 2: occupied, 3: inner node
  unsigned write(int depth, const Key& key, std::string& bytes) {
    const int edge = 1 << (16 - depth);
    for (const int along : key) {
      if (along >= 8 || along + edge <= -8) return 0;
    }
    if (depth == 16) return static_cast<unsigned>(at(key[0] + 8, key[1] + 8, key[2] + 8));
    unsigned children = 0, all = 0;
    std::string below;
    for (unsigned i = 0; i < 8; ++i) {
      const auto along = [&](std::size_t axis) { return key[axis] + static_cast<int>(i >> axis & 1U) * edge / 2; };
      const unsigned child = write(depth + 1, {along(0), along(1), along(2)}, below);
      children |= child << (2 * i);
      all |= 1U << child;
    }
    if (all == 1U || all == 2U || all == 4U) return all >> 1;
    bytes += static_cast<char>(children & 255U);
    bytes += static_cast<char>(children >> 8);
    bytes += below;
    return 3;
  }

  std::array<char, 4096> cubes_;
  std::string tree_;
};

std::string drawn_tree(std::mt19937& random) { return DrawnCubes(random).tree(); }

TEST(CubeRuns, CoverTheLeavesOfTheTree) {
  std::mt19937 random(3);
  std::size_t occupied = 0, free = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::string tree = drawn_tree(random);
    const double slice_m = 0.25 + 0.5 * (static_cast<double>(random() % 16) - 8.0);
    const std::set<Cube> all = cubes_of(tree, true, {});
    const auto map = shown_map(tree, 0.5, slice_m);
    ASSERT_TRUE(map);
    EXPECT_LE(map->occupied.size(), kMostRuns);
    EXPECT_EQ(map->slice_cell_m, 0.5);
    EXPECT_EQ(cubes_of(map->free), cubes_of(tree, false, cell_of(slice_m, 0.5)));
    std::set<Cube> expected;
    const int times = static_cast<int>(map->cell_m / 0.5);
    const auto coarse = [&](int cube) { return static_cast<int>(std::floor(static_cast<double>(cube) / times)); };
    for (const auto& [z, y, x] : all) expected.emplace(coarse(z), coarse(y), coarse(x));
    EXPECT_EQ(cubes_of(map->occupied), expected);
    occupied += expected.size();
    free += map->free.size();
  }
  EXPECT_GT(occupied, 1000U);
  EXPECT_GT(free, 100U);
}

TEST(CubeRuns, AreOfLargerCubesIfThereAreTooMany) {
  std::mt19937 random(4);
  std::size_t coarse = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::string tree = drawn_tree(random);
    const auto fine = shown_map(tree, 0.5, 1.0), few = shown_map(tree, 0.5, 1.0, 20);
    ASSERT_TRUE(fine && few);
    EXPECT_LE(few->occupied.size(), 20U);
    EXPECT_LE(few->free.size(), 20U);
    EXPECT_EQ(few->occupied.empty(), fine->occupied.empty());
    if (fine->cell_m == 0.5 && few->cell_m > 0.5) ++coarse;
    for (const auto& [z, y, x] : cubes_of(fine->occupied)) {
      const double share = fine->cell_m / few->cell_m;
      const auto in = [&](int cube) { return static_cast<int>(std::floor(share * cube)); };
      const bool there = std::ranges::any_of(few->occupied, [&](const CubeRun& run) {
        return run.z == in(z) && run.y == in(y) && run.x <= in(x) && in(x) < run.x + run.length;
      });
      ASSERT_TRUE(there) << x << ' ' << y << ' ' << z;
    }
  }
  EXPECT_GT(coarse, 5U);
}

TEST(CubeRuns, AreReducedToFourRowsAtLeast) {
  std::mt19937 random(6);
  std::size_t four = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::string tree = drawn_tree(random);
    const std::size_t most = random() % 6;
    const auto map = shown_map(tree, 0.5, 1.0, most);
    ASSERT_TRUE(map);
    EXPECT_LE(map->occupied.size(), std::max(most, kLeastRuns));
    EXPECT_LE(map->free.size(), std::max(most, kLeastRuns));
    if (most < kLeastRuns && map->occupied.size() == kLeastRuns) ++four;
  }
  EXPECT_GT(four, 5U) << "cubes on all sides of the origin need four rows";
}

TEST(CubeRuns, AreUnpackedAsTheyWerePacked) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<CubeRun> runs;
    for (unsigned i = random() % 200; i > 0; --i) {
      const int reach = random() % 20 == 0 ? 40'000 : 6;
      const auto along = [&] { return static_cast<int>(random() % (2U * static_cast<unsigned>(reach))) - reach; };
      const int x = along(), y = along(), z = along();
      runs.push_back({x, y, z, 1 + static_cast<int>(random() % 5 == 0 ? random() % 300 : random() % 3)});
    }
    runs = joined_runs(std::move(runs));
    EXPECT_EQ(unpacked_runs(packed(runs)), runs);
  }
  EXPECT_EQ(packed({}), "");
  // Reference vector of the format that web/src/packed.js unpacks.
  const std::vector<CubeRun> rows = {{-3, 2, 1, 4}, {5, 2, 1, 1}, {300, -70, 2, 130}};
  EXPECT_EQ(packed(rows), "BgIEBQEEggICjwHOBA==");
}

TEST(CubeRuns, RefuseMapsThatAreTooLargeToBeReal) {
  EXPECT_TRUE(shown_map("", 0.5, 1.0).has_value()) << "an empty map is valid";
  EXPECT_FALSE(shown_map("x", 0.5, 1.0).has_value());
  EXPECT_FALSE(shown_map(std::string("\x02\x00", 2), 0.5, 1.0).has_value()) << "an eighth of the world is occupied";
  EXPECT_FALSE(shown_map(std::string("\x01\x00", 2), 0.5, 1.0).has_value()) << "an eighth of the world is free";
  for (const double cell_m : {0.0, -1.0, 1e9, std::nan("")}) EXPECT_FALSE(shown_map("", cell_m, 1.0).has_value());
  EXPECT_FALSE(shown_map("", 0.5, std::nan("")).has_value());
}

TEST(CubeRuns, AreSentWithTheNameOfTheirMap) {
  const Json told =
      parse_json(map_text("a", 12.5, {0.5, {{1, 2, 3, 4}}, 1.0, 4.25, {{0, 0, 4, 2}}}, "what it flies on"));
  EXPECT_EQ(told["n"], "map a");
  EXPECT_EQ(told["t"], 12.5);
  EXPECT_EQ(told["cell"], 0.5);
  EXPECT_EQ(told["steps"][0]["t"], 12.5);
  EXPECT_EQ(unpacked_runs(told["steps"][0]["runs"].get<std::string>()), (std::vector<CubeRun>{{1, 2, 3, 4}}));
  EXPECT_EQ(unpacked_runs(told["free"].get<std::string>()), (std::vector<CubeRun>{{0, 0, 4, 2}}));
  EXPECT_EQ(told["freeCell"], 1.0);
  EXPECT_EQ(told["z"], 4.25);
  EXPECT_EQ(told["kind"], "what it flies on");
  EXPECT_EQ(parse_json(no_map_text("a", 1.0, "why"))["none"], "why");
}

}  // namespace
}  // namespace skein::view
