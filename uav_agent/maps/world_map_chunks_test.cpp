// Tests of WorldMap::read() and WorldMap::rows(), which must agree with WorldMap::known() of each cube.
#include <gtest/gtest.h>

#include <array>

#include "core/math/random_stream.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

constexpr int kMost = 16;  // cubes along each axis, from the origin in both directions: four chunks

/// A map in which cubes of all sizes are free, and smaller ones among them unknown or occupied.
void draw(WorldMap& map, RandomStream& random) {
  const auto drawn = [&](int level) {
    const auto along = [&] { return static_cast<int>(random.uniform(-kMost, kMost)) >> level; };
    const int x = along(), y = along(), z = along();
    return WorldMap::Cube(x, y, z);
  };
  for (int level = map.levels() - 1; level >= 0; --level) {
    for (int i = 0; i < 40; ++i) map.hear(drawn(level), level, Space::free, static_cast<Teller>(level));
  }
  for (int i = 0; i < 200; ++i) map.hear(drawn(0), 0, Space::occupied, 2);
  for (int i = 0; i < 40; ++i) map.doubt(drawn(0));
  for (int i = 0; i < 10; ++i) map.vacate(map.middle_W(drawn(0)), 1.0);
}

TEST(WorldMapChunks, AgreeWithWhatIsKnownOfEachCube) {
  for (std::uint64_t world = 1; world <= 5; ++world) {
    RandomStream random(world, "chunks", 0);
    WorldMap map(WorldMap::Config{});
    draw(map, random);
    std::array<int, 3> found = {};
    for (int i = 0; i < 6 * 6 * 6; ++i) {  // one chunk more on each side
      const WorldMap::Cube at = WorldMap::Cube(i % 6, i / 6 % 6, i / 36) - WorldMap::Cube::Constant(3);
      WorldMap::Chunk chunk;
      map.read(at, chunk);
      const std::array rows = {map.rows(at, Space::unknown), map.rows(at, Space::free), map.rows(at, Space::occupied)};
      for (std::size_t place = 0; place < chunk.size(); ++place) {
        const WorldMap::Cube cube = WorldMap::kChunk * at + MapLevel::in_block(place);
        const auto space = static_cast<std::size_t>(map.known(cube).space);
        ++found[space];
        ASSERT_EQ(chunk[place], map.known(cube)) << cube.transpose();
        for (std::size_t asked = 0; asked < rows.size(); ++asked) {
          const bool is_set = (rows[asked][place / kRowCells] >> place % kRowCells & 1) != 0;
          ASSERT_EQ(is_set, asked == space) << cube.transpose() << ", state " << asked;
        }
      }
    }
    for (const int count : found) EXPECT_GT(count, 100) << "of a state in world " << world;
  }
}

}  // namespace
}  // namespace skein::agent
