// Only time during which the waiting process ran counts as waiting.
#include "bus/lockstep/patience.hpp"

#include <gtest/gtest.h>

namespace skein::bus {
namespace {

using namespace std::chrono_literals;
using Time = Patience::Clock::time_point;

TEST(Patience, IsOverWhenTheTimeIsUp) {
  const Time start{};
  Patience patience(2.0, start);
  EXPECT_FALSE(patience.over(start + 1s));
  EXPECT_FALSE(patience.over(start + 1900ms));
  EXPECT_TRUE(patience.over(start + 2100ms));
}

TEST(Patience, DoesNotCountTheTimeInWhichItsProcessStoodStill) {
  const Time start{};
  Patience patience(2.0, start);
  EXPECT_FALSE(patience.over(start + 1h)) << "a process that was stopped has not yet seen what arrived meanwhile";
  EXPECT_FALSE(patience.over(start + 1h + 500ms));
  EXPECT_TRUE(patience.over(start + 1h + 1100ms));
}

TEST(Patience, WithoutALimitLastsForEver) {
  const Time start{};
  Patience patience(0.0, start);
  for (int s = 1; s < 10000; ++s) ASSERT_FALSE(patience.over(start + std::chrono::seconds(s)));
}

}  // namespace
}  // namespace skein::bus
