#include "tests/support/counted_memory.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace skein::test {
namespace {

constexpr std::size_t kBlock = 1'000'000, kSlack = 10'000;

/// A variable that is written to, so that the compiler cannot remove the allocation.
void use_block() {
  std::vector<char> block(kBlock, 'a');
  ASSERT_EQ(block[kBlock / 2], 'a');
}

TEST(CountedMemory, CountsAllMemoryAndTheMaximumInUse) {
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
  EXPECT_LE(memory.peak(), kSlack) << "freed memory from before the count began must not be added to the maximum";
}

}  // namespace
}  // namespace skein::test
