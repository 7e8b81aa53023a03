#include "tests/support/counted_memory.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace skein::test {
namespace {

constexpr std::size_t kBlock = 1'000'000, kSlack = 10'000;

/// Written to, so that the compiler cannot do without it.
void use_block() {
  std::vector<char> block(kBlock, 'a');
  ASSERT_EQ(block[kBlock / 2], 'a');
}

TEST(CountedMemory, CountsAllAndTheMostAtOneTime) {
  const CountedMemory memory;
  EXPECT_LE(memory.allocated(), kSlack);
  use_block();
  use_block();
  EXPECT_GE(memory.allocated(), 2 * kBlock);
  EXPECT_LE(memory.allocated(), 2 * kBlock + kSlack);
  EXPECT_GE(memory.peak(), kBlock);
  EXPECT_LE(memory.peak(), kBlock + kSlack);
}

TEST(CountedMemory, CountsOtherThreads) {
  const CountedMemory memory;
  std::thread(use_block).join();
  EXPECT_GE(memory.peak(), kBlock);
}

TEST(CountedMemory, MemoryInUseBeforeMayBeFreed) {
  auto before = std::make_unique<std::vector<char>>(kBlock);
  const CountedMemory memory;
  before.reset();
  use_block();
  EXPECT_LE(memory.peak(), kSlack) << "no more is in use than at the start";
}

}  // namespace
}  // namespace skein::test
