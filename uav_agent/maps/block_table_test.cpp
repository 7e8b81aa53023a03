#include "uav_agent/maps/block_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

/// A key as maps number their blocks: three coordinates of 21 bits each, on both sides of the origin.
std::uint64_t drawn_key(RandomStream& random, int half) {
  const auto along = [&] { return static_cast<std::uint64_t>(random.uniform(-half, half)) & ((1U << 21) - 1); };
  const std::uint64_t x = along(), y = along(), z = along();
  return x | y << 21 | z << 42;
}

TEST(BlockTable, AnswersLikeAStdMapAtEverySize) {
  for (std::uint64_t world = 0; world < 40; ++world) {
    RandomStream random(world, "blocks", 0);
    BlockTable<int> table;
    std::map<std::uint64_t, int> all;
    for (int i = 0, count = 1 << (world % 13); i < count; ++i) {
      const std::uint64_t key = drawn_key(random, 12);
      ASSERT_EQ(table[key], all[key]) << "0 where there was none";
      table[key] = all[key] = i;
    }
    for (int i = 0; i < 2000; ++i) {
      const std::uint64_t key = drawn_key(random, 14);
      const int* const found = table.find(key);
      ASSERT_EQ(found != nullptr, all.contains(key)) << world << ": " << key;
      if (found != nullptr) {
        ASSERT_EQ(*found, all.at(key));
      }
    }
  }
}

TEST(BlockTable, AClearedTableBehavesLikeANewOne) {
  RandomStream random(3, "cleared_blocks", 0);
  BlockTable<int> table;
  std::map<std::uint64_t, int> all;
  for (int i = 0; i < 500; ++i) table[drawn_key(random, 12)] = 7;
  table.clear();
  for (int i = 0; i < 500; ++i) {
    const std::uint64_t key = drawn_key(random, 12);
    ASSERT_EQ(table.find(key) != nullptr, all.contains(key));
    ASSERT_EQ(table[key], all[key]) << "0 where there was none";
    table[key] = all[key] = i;
  }
}

TEST(BlockTable, TablesWithTheSameContentAreEqualInAnyOrder) {
  for (std::uint64_t world = 0; world < 20; ++world) {
    RandomStream random(world, "equal_blocks", 0);
    std::map<std::uint64_t, int> all;
    for (int i = 1; i < 300; ++i) all[drawn_key(random, 20)] = i;
    BlockTable<int> forth, back;
    for (auto it = all.begin(); it != all.end(); ++it) forth[it->first] = it->second;
    for (auto it = all.rbegin(); it != all.rend(); ++it) back[it->first] = it->second;
    EXPECT_TRUE(forth == back);
    ++back[all.begin()->first];
    EXPECT_FALSE(forth == back) << "one block differs";
    --back[all.begin()->first];
    EXPECT_TRUE(forth == back);
    back[drawn_key(random, 20) | std::uint64_t{1} << 62] = 0;
    EXPECT_FALSE(forth == back) << "one table has a block more";
  }
}

}  // namespace
}  // namespace skein::agent
