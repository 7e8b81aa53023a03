// The fields of a shared block do not overlap, are aligned, and have the places that their description names.
#include "core/planners/block_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

TEST(BlockLayout, DescribesFieldsAsNumPyNeedsThem) {
  BlockLayout layout;
  const auto map = layout.add<std::int8_t>("map", {2, 3, 1});
  const auto time = layout.add<double>("time_s");
  const auto none = layout.add<float>("scan", {0, 3});
  const std::vector<BlockField> expected = {
      {"map", "|i1", {2, 3, 1}, 0}, {"time_s", "<f8", {}, 8}, {"scan", "<f4", {0, 3}, 16}};
  EXPECT_EQ(layout.fields(), expected);
  EXPECT_EQ(map.size, 6U);
  EXPECT_EQ(time.size, 1U);
  EXPECT_EQ(none.size, 0U);
  EXPECT_EQ(layout.bytes(), 16U);
}

/// Random layouts: a value written to a field is read from this field, and changes no other.
TEST(BlockLayout, FieldsDoNotOverlap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "block layout", 0);
    BlockLayout layout;
    std::vector<BlockArray<std::int8_t>> flags;
    std::vector<BlockArray<double>> numbers;
    for (int i = 0; i < 12; ++i) {
      const std::vector<std::size_t> shape(random.bits() % 3, 1 + random.bits() % 4);
      if (random.uniform() < 0.5) {
        flags.push_back(layout.add<std::int8_t>("flag", shape));
      } else {
        numbers.push_back(layout.add<double>("number", shape));
        EXPECT_EQ(numbers.back().offset % alignof(double), 0U);
      }
    }
    std::vector<std::byte> block(layout.bytes());
    for (std::size_t i = 0; i < flags.size(); ++i)
      std::ranges::fill(flags[i].in(block.data()), static_cast<std::int8_t>(i));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      std::ranges::fill(numbers[i].in(block.data()), 0.5 * static_cast<double>(i));
    for (std::size_t i = 0; i < flags.size(); ++i) {
      for (const std::int8_t flag : flags[i].in(block.data())) EXPECT_EQ(flag, static_cast<std::int8_t>(i));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      for (const double number : numbers[i].in(block.data())) EXPECT_EQ(number, 0.5 * static_cast<double>(i));
    }
  }
}

}  // namespace
}  // namespace skein
