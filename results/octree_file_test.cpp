#include "results/octree_file.hpp"

#include <gtest/gtest.h>

#include <random>

#include "results/testing/drawn_map.hpp"

namespace skein::results {
namespace {

std::vector<KnownCube> cubes_of(const std::string& file) {
  std::vector<KnownCube> cubes;
  EXPECT_TRUE(visit_octree_file(file, [&](const KnownCube& cube) { cubes.push_back(cube); }));
  return cubes;
}

std::string file_of(const std::string& data, std::size_t nodes) {
  return "# Octomap OcTree binary file\n# comment\n#\nid OcTree\nsize " + std::to_string(nodes) + "\nres 0.5\ndata\n" +
         data;
}

TEST(OctreeFile, LeavesAreReadAtTheirPlaces) {
  // Of the root's children, the one at -x -y -z is free, and that at +x -y -z is occupied. The one at +x +y +z has an
  // occupied child at its lowest corner.
  const auto cubes = cubes_of(file_of({"\x09\xC0\x02\x00", 4}, 5));
  ASSERT_EQ(cubes.size(), 3U);
  constexpr double kHalf_m = 16384.0;
  EXPECT_EQ(cubes[0].lowest_W, Vector3d::Constant(-kHalf_m));
  EXPECT_EQ(cubes[0].edge_m, kHalf_m);
  EXPECT_FALSE(cubes[0].occupied);
  EXPECT_EQ(cubes[1].lowest_W, Vector3d(0.0, -kHalf_m, -kHalf_m));
  EXPECT_TRUE(cubes[1].occupied);
  EXPECT_EQ(cubes[2].lowest_W, Vector3d::Zero());
  EXPECT_EQ(cubes[2].edge_m, 0.5 * kHalf_m);
}

TEST(OctreeFile, AnEmptyMapHasNoCubes) { EXPECT_TRUE(cubes_of(file_of("", 0)).empty()); }

TEST(OctreeFile, ACutOffOrAlteredFileIsNeverReadBeyondItsEnd) {
  std::mt19937 random(1);
  std::size_t refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::string file = drawn_map(random);
    EXPECT_TRUE(visit_octree_file(file, [](const KnownCube&) {}));
    const std::string cut = file.substr(0, random() % file.size());
    EXPECT_FALSE(visit_octree_file(cut, [](const KnownCube&) {})) << cut;
    EXPECT_FALSE(visit_octree_file(file + "x", [](const KnownCube&) {}));
    std::string altered = file;
    altered[random() % altered.size()] = static_cast<char>(random());
    refused += visit_octree_file(altered, [](const KnownCube&) {}) ? 0 : 1;
  }
  EXPECT_GT(refused, 50U);
  for (const char* text : {"", "x", "# Octomap OcTree binary file\n", "# Octomap OcTree binary file\nid OcTree\ndata\n",
                           "# Octomap OcTree binary file\nid ColorOcTree\nsize 0\nres 0.5\ndata\n",
                           "# Octomap OcTree binary file\nid OcTree\nsize 0\nres nan\ndata\n",
                           "# Octomap OcTree binary file\nid OcTree\nsize 0\nres 0\ndata\n",
                           "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.5\ndata\n"}) {
    EXPECT_FALSE(visit_octree_file(text, [](const KnownCube&) {})) << text;
  }
}

}  // namespace
}  // namespace skein::results
