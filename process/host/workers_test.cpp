#include "process/host/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <set>
#include <stdexcept>

#include "core/math/random_stream.hpp"
#include "process/host/thread_cpu.hpp"

namespace skein {
namespace {

std::uint64_t mixed(std::uint64_t seed, int rounds) {
  for (int i = 0; i < rounds; ++i) seed = seed * 6364136223846793005U + 1442695040888963407U;
  return seed;
}

class WorkersTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, WorkersTest, testing::Values(1, 2, 3, 16));

TEST_P(WorkersTest, EachPieceIsDoneOnceForAnyLength) {
  Workers workers(GetParam());
  EXPECT_EQ(workers.threads(), GetParam());
  RandomStream random(static_cast<std::uint64_t>(GetParam()), "pieces", 0);
  for (int job = 0; job < 300; ++job) {
    const std::size_t count = random.bits() % 40;
    std::vector<int> lengths(count);
    for (int& length : lengths) length = static_cast<int>(random.bits() % 3000);
    std::vector<std::uint64_t> done(count);  // written without a lock, because each piece has one thread
    workers.run(count, [&](std::size_t i) { done[i] += mixed(i, lengths[i]); });
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(done[i], mixed(i, lengths[i])) << job << " " << i;
  }
}

TEST_P(WorkersTest, RunThrowsTheFailureOfTheFirstPiece) {
  Workers workers(GetParam());
  std::atomic<int> at_work = 0;
  try {
    workers.run(20, [&](std::size_t i) {
      ++at_work;
      mixed(i, 1000);
      --at_work;
      if (i == 7 || i == 13) throw std::runtime_error(std::to_string(i));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "7");
  }
  EXPECT_EQ(at_work, 0);
  int again = 0;
  workers.run(1, [&](std::size_t) { ++again; });
  EXPECT_EQ(again, 1) << "the workers can be used again after a failure";
}

TEST_P(WorkersTest, WorkWithinWorkStaysOnItsThread) {
  Workers workers(GetParam());
  std::vector<std::set<int>> threads(8);
  workers.run(threads.size(),
              [&](std::size_t i) { workers.run(5, [&](std::size_t) { threads[i].insert(Workers::here()); }); });
  for (const std::set<int>& one : threads) EXPECT_EQ(one.size(), 1U);
  EXPECT_EQ(Workers::here(), 0);
}

TEST_P(WorkersTest, TheCpuTimeOfHelpersCountsForTheCaller) {
  Workers workers(GetParam());
  constexpr double kPiece_s = 0.01;
  const double before_s = thread_cpu_s();
  workers.run(16, [](std::size_t) {
    for (const double until_s = thread_cpu_s() + kPiece_s; thread_cpu_s() < until_s;) {
    }
  });
  EXPECT_GE(thread_cpu_s() - before_s, 16 * kPiece_s);
}

}  // namespace
}  // namespace skein
