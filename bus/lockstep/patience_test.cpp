// Patience counts only the time in which the waiting process runs. A gap of more than 1 s between two calls of over()
// counts as 1 s.
#include "bus/lockstep/patience.hpp"

#include <gtest/gtest.h>

namespace skein::bus {
namespace {

using namespace std::chrono_literals;
using Time = Patience::Clock::time_point;

TEST(Patience, IsOverOnceTheLimitHasPassed) {
  const Time start{};
  Patience patience(2.0, start);
  EXPECT_FALSE(patience.over(start + 1s));
  EXPECT_FALSE(patience.over(start + 1900ms));
  EXPECT_TRUE(patience.over(start + 2100ms));
}

TEST(Patience, DoesNotCountTheTimeInWhichTheProcessWasStopped) {
  const Time start{};
  Patience patience(2.0, start);
  EXPECT_FALSE(patience.over(start + 1h)) << "a process that was stopped for an hour must first read what has arrived";
  EXPECT_FALSE(patience.over(start + 1h + 500ms));
  EXPECT_TRUE(patience.over(start + 1h + 1100ms));
}

TEST(Patience, WithoutALimitIsNeverOver) {
  const Time start{};
  Patience patience(0.0, start);
  for (int s = 1; s < 10000; ++s) ASSERT_FALSE(patience.over(start + std::chrono::seconds(s)));
}

}  // namespace
}  // namespace skein::bus
