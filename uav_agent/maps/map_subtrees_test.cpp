#include "uav_agent/maps/map_subtrees.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <map>
#include <sstream>
#include <tuple>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/news_radio.hpp"

namespace skein::agent {
namespace {

using CubeNumber = std::tuple<int, int, int>;
using ChunkSpaces = std::map<CubeNumber, WorldMap::Chunk>;  ///< by number of the chunk

int drawn_below(RandomStream& random, int count) {
  return static_cast<int>(random.uniform() * static_cast<double>(count));
}

/// A chunk of cubes of random sizes, some within others; or of equal cubes only.
WorldMap::Chunk drawn_chunk(RandomStream& random) {
  WorldMap::Chunk chunk;
  const auto any = [&] { return static_cast<Space>(drawn_below(random, 3)); };
  chunk.fill({drawn_below(random, 3) == 0 ? Space::unknown : any(), kOwn});
  if (drawn_below(random, 3) == 0) return chunk;
  for (int cubes = drawn_below(random, 40); cubes > 0; --cubes) {
    const int level = drawn_below(random, 3), edge = 1 << level;
    const Eigen::Vector3i corner(drawn_below(random, 8 >> level), drawn_below(random, 8 >> level),
                                 drawn_below(random, 8 >> level));
    const Space space = any();
    for (int i = 0; i < edge * edge * edge; ++i) {
      const Eigen::Vector3i at = corner * edge + Eigen::Vector3i(i % edge, i / edge % edge, i / (edge * edge));
      chunk[static_cast<std::size_t>(at.x() + 8 * (at.y() + 8 * at.z()))].space = space;
    }
  }
  return chunk;
}

bool all_unknown(const WorldMap::Chunk& chunk) {
  return std::ranges::all_of(chunk, [](const MapLevel::Known& cube) { return cube.space == Space::unknown; });
}

/// Draws chunks that touch each other, also across the origin, and chunks that are as far away as the tree reaches.
ChunkSpaces drawn_chunks(RandomStream& random) {
  ChunkSpaces chunks;
  const bool free = drawn_below(random, 4) == 0;  // in large blocks
  for (int i = drawn_below(random, 120); i >= 0; --i) {
    const int reach = drawn_below(random, 10) == 0 ? 4096 : 3;
    const auto along = [&] { return drawn_below(random, 2 * reach) - reach; };
    const CubeNumber at(along(), along(), along());
    WorldMap::Chunk chunk = drawn_chunk(random);
    if (free) chunk.fill({Space::free, kOwn});
    if (!all_unknown(chunk)) chunks[at] = chunk;
  }
  return chunks;
}

std::vector<std::uint8_t> tree_of(const ChunkSpaces& chunks) {
  std::vector<Subtree> subtrees;
  for (const auto& [at, chunk] : chunks) {
    subtrees.push_back(subtree_of({std::get<0>(at), std::get<1>(at), std::get<2>(at)}, chunk));
  }
  return join_subtrees(subtrees);
}

Space space_at(const ChunkSpaces& chunks, const Eigen::Vector3i& cube) {
  const auto found = chunks.find({cube.x() >> 3, cube.y() >> 3, cube.z() >> 3});
  if (found == chunks.end()) return Space::unknown;
  const auto place = (cube.x() & 7) + 8 * ((cube.y() & 7) + 8 * (cube.z() & 7));
  return found->second[static_cast<std::size_t>(place)].space;
}

TEST(MapSubtrees, OctoMapReadsEachTreeAloneAndSeesTheSameCubes) {
  constexpr double kCellM = 0.5;
  RandomStream random(1, "octomap_reads", 0);
  std::size_t seen[3] = {};
  for (int drawn = 0; drawn < 120; ++drawn) {
    const ChunkSpaces chunks = drawn_chunks(random);
    const std::vector<std::uint8_t> bytes = tree_of(chunks);
    if (bytes.empty()) continue;
    std::stringstream stream(std::string(bytes.begin(), bytes.end()));
    octomap::OcTree tree(kCellM);
    tree.readBinaryData(stream);
    ASSERT_EQ(static_cast<std::size_t>(stream.tellg()), bytes.size()) << "OctoMap reads all bytes";
    for (const auto& [at, chunk] : chunks) {
      const auto& [x, y, z] = at;
      for (int i = 0; i < 10 * 10 * 10; ++i) {  // and a cube beyond on all sides
        const Eigen::Vector3i cube =
            8 * Eigen::Vector3i(x, y, z) + Eigen::Vector3i(i % 10, i / 10 % 10, i / 100) - Eigen::Vector3i::Ones();
        if (cube.minCoeff() < -32768 || cube.maxCoeff() > 32767) continue;
        const Vector3d p_W = (cube.cast<double>() + Vector3d::Constant(0.5)) * kCellM;
        const octomap::OcTreeNode* const node = tree.search(p_W.x(), p_W.y(), p_W.z());
        const Space told = node == nullptr ? Space::unknown : tree.isNodeOccupied(node) ? Space::occupied : Space::free;
        ASSERT_EQ(told, space_at(chunks, cube)) << cube.transpose();
        ++seen[static_cast<std::size_t>(told)];
      }
    }
  }
  for (const std::size_t cubes : seen) EXPECT_GT(cubes, 100'000U);
}

TEST(MapSubtrees, AMapThatReadsATreeKnowsTheSameCubes) {
  RandomStream random(2, "map_reads", 0);
  for (int drawn = 0; drawn < 60; ++drawn) {
    const ChunkSpaces chunks = drawn_chunks(random);
    const std::vector<double> to_m = {8.0, 16.0, 32.0, 64.0};
    WorldMap::Config config;
    config.to_m.assign(to_m.begin(), to_m.begin() + 1 + drawn % 4);
    WorldMap map(config);
    const auto cubes = read_subtrees(tree_of(chunks), map.levels());
    ASSERT_TRUE(cubes.has_value());
    for (const HeardCube& cube : *cubes) map.hear(cube.cube, cube.level, cube.space, 2);
    std::size_t heard = 0;
    for (const auto& [at, chunk] : chunks) {
      const Eigen::Vector3i number(std::get<0>(at), std::get<1>(at), std::get<2>(at));
      WorldMap::Chunk known;
      map.read(number, known);
      for (std::size_t i = 0; i < chunk.size(); ++i) ASSERT_EQ(known[i].space, chunk[i].space);
    }
    for (const Eigen::Vector3i& region : map.regions()) {
      for (int i = 0; i < 64; ++i) {
        const Eigen::Vector3i chunk = 4 * region + Eigen::Vector3i(i & 3, i >> 2 & 3, i >> 4);
        heard += map.changed_at(chunk) > 0;
      }
    }
    EXPECT_EQ(heard, chunks.size()) << "no other chunk has changed";
  }
}

TEST(MapSubtrees, UniformSpaceIsOneLeafOfUpToFourChunks) {
  ChunkSpaces chunks;
  WorldMap::Chunk all;
  const auto fill = [&](int edge, Space space) {
    all.fill({space, kOwn});
    chunks.clear();
    for (int i = 0; i < edge * edge * edge; ++i) chunks[{i % edge, i / edge % edge, i / (edge * edge)}] = all;
    return tree_of(chunks).size();
  };
  EXPECT_EQ(fill(1, Space::free), 2U * 13U) << "the nodes above the leaf";
  EXPECT_EQ(fill(2, Space::free), 2U * 12U);
  EXPECT_EQ(fill(4, Space::free), 2U * 11U);
  EXPECT_EQ(fill(8, Space::free), 2U * 11U) << "readers need not expect larger leaves";
  EXPECT_EQ(fill(1, Space::occupied), 2U * 13U);
  EXPECT_EQ(fill(2, Space::occupied), 2U * 13U);
  EXPECT_TRUE(tree_of({}).empty());
  EXPECT_EQ(read_subtrees({}, 3), std::vector<HeardCube>());
}

TEST(MapSubtrees, TreesThatAreTooLargeOrTooDeepAreRefused) {
  const std::vector<std::uint8_t> all_free = {0x55, 0x55}, all_occupied = {0xAA, 0xAA};
  EXPECT_FALSE(read_subtrees(all_free, 3)) << "32 km of free space";
  EXPECT_FALSE(read_subtrees(all_occupied, 3));
  std::vector<std::uint8_t> many(2, 0xFF);  // only inner nodes, no leaves
  for (int i = 0; i < 1 << 13; ++i) many.insert(many.end(), {0xFF, 0xFF});
  EXPECT_FALSE(read_subtrees(many, 3)) << "the tree does not end";
  const auto free_below = [](int depth) {  // eight leaves below a chain of nodes with one child each
    std::vector<std::uint8_t> bytes;
    for (int i = 1; i < depth; ++i) bytes.insert(bytes.end(), {0x03, 0x00});
    bytes.insert(bytes.end(), {0x55, 0x55});
    return bytes;
  };
  EXPECT_FALSE(read_subtrees(free_below(10), 3)) << "leaves of 32 m are too large";
  const auto regions = read_subtrees(free_below(11), 3);
  ASSERT_TRUE(regions.has_value());
  EXPECT_EQ(regions->size(), 8U * 512U);
  EXPECT_EQ(regions->front(), (HeardCube{Eigen::Vector3i::Constant(-8192), 2, Space::free}));
  EXPECT_FALSE(read_subtrees(free_below(17), 3)) << "deeper than trees may be";
}

TEST(MapSubtrees, DamagedTreesAreRefusedOrWithinBounds) {
  RandomStream random(3, "damaged_trees", 0);
  std::size_t read = 0, refused = 0;
  for (int drawn = 0; drawn < 4000; ++drawn) {
    std::vector<std::uint8_t> bytes;
    if (drawn % 4 == 0) {
      bytes.resize(static_cast<std::size_t>(drawn_below(random, 400)));
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
    } else {
      static const std::vector<std::uint8_t> whole = tree_of(drawn_chunks(random));
      bytes = whole;
      for (int flips = drawn_below(random, 4); flips > 0; --flips) {
        const auto at = static_cast<std::size_t>(drawn_below(random, static_cast<int>(bytes.size())));
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ 1U << drawn_below(random, 8));
      }
      if (drawn % 4 == 1) bytes.resize(static_cast<std::size_t>(drawn_below(random, static_cast<int>(bytes.size()))));
    }
    const auto cubes = read_subtrees(bytes, 1 + drawn % 4);
    ++(cubes ? read : refused);
    if (!cubes) continue;
    ASSERT_LE(cubes->size(), kMostHeardCubes);
    for (const HeardCube& cube : *cubes) {
      ASSERT_GE(cube.cube.minCoeff() * (1 << cube.level), -32768);
      ASSERT_LT(cube.cube.maxCoeff() * (1 << cube.level), 32768);
      ASSERT_TRUE(cube.level == 0 || cube.space == Space::free);
    }
  }
  EXPECT_GT(read, 100U);
  EXPECT_GT(refused, 1000U);
}

/// Regions that are completely free take no memory, and no received information is lost.
TEST(HeardMap, StaysSmallAndKnowsAllThatItReceived) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random(seed, "heard_map", 0);
    WorldMap map(WorldMap::Config{});
    constexpr int kEdge = 16, kMixedEach = 20;
    std::size_t mixed = 0;
    for (int i = 0; i < kEdge * kEdge * kEdge; ++i) {
      const Eigen::Vector3i chunk =
          Eigen::Vector3i(i % kEdge, i / kEdge % kEdge, i / (kEdge * kEdge)) - Eigen::Vector3i::Constant(kEdge / 2);
      const bool whole = random.uniform() * kMixedEach > 1.0;
      mixed += !whole;
      std::vector<HeardCube> cubes;
      for (std::size_t at = 0; at < MapLevel::kCells; ++at) {
        const Eigen::Vector3i cube = chunk * WorldMap::kChunk + MapLevel::in_block(at);
        const Space space = whole || random.uniform() < 0.5 ? Space::free : Space::occupied;
        if (whole || random.uniform() < 0.8) cubes.push_back({cube, 0, space});
      }
      map.hear(cubes, 1);
      for (const HeardCube& cube : cubes) ASSERT_EQ(map.known(cube.cube), (MapLevel::Known{cube.space, 1}));
      WorldMap::Chunk known;
      map.read(chunk, known);
      for (std::size_t at = 0; at < MapLevel::kCells; ++at) {
        ASSERT_EQ(known[at], map.known(chunk * WorldMap::kChunk + MapLevel::in_block(at)));
      }
    }
    EXPECT_LE(map.counts().blocks, mixed + mixed / 4 + 257);
    EXPECT_LT(map.counts().bytes, 4'000'000U) << "5 % of the chunks, a byte or two a cube";
  }
}

TEST(HeardMap, ReadGivesTheStateOfEachCubeOfAChunk) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, "read_chunks", 0);
    WorldMap::Config config;
    if (seed % 2 == 0) config.to_m = {2.0, 4.0, 8.0, 16.0};
    WorldMap map(config);
    test::draw_space(map, random, Vector3d::Zero(), 12.0, 300);
    WorldMap::Chunk known;
    for (int i = 0; i < 8 * 8 * 8; ++i) {
      const Eigen::Vector3i chunk(i % 8 - 4, i / 8 % 8 - 4, i / 64 - 4);
      map.read(chunk, known);
      for (std::size_t at = 0; at < MapLevel::kCells; ++at) {
        ASSERT_EQ(known[at], map.known(chunk * WorldMap::kChunk + MapLevel::in_block(at)));
      }
    }
  }
}

}  // namespace
}  // namespace skein::agent
