#include "core/run/wait_notice.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace skein {
namespace {

using std::chrono::seconds;

TEST(WaitNotice, IsDueAfterFiveSecondsAndThenLessAndLessOften) {
  const WaitNotice::Clock::time_point start{};
  WaitNotice notice(start);
  std::vector<double> told;
  for (int s = 0; s <= 100; ++s) {
    if (const auto waited_s = notice.due(start + seconds(s))) told.push_back(*waited_s);
  }
  EXPECT_EQ(told, (std::vector<double>{5, 10, 20, 40, 80}));
}

TEST(WaitNotice, ACallerThatAsksLateIsToldOnce) {
  const WaitNotice::Clock::time_point start{};
  WaitNotice notice(start);
  EXPECT_EQ(notice.left(start + seconds(1)), seconds(4));
  EXPECT_EQ(notice.left(start + seconds(50)), seconds(0));
  EXPECT_EQ(notice.due(start + seconds(50)), 50.0);
  EXPECT_FALSE(notice.due(start + seconds(50)));
  EXPECT_EQ(notice.left(start + seconds(50)), seconds(30));
}

}  // namespace
}  // namespace skein
