#include "run/leave_deadline.hpp"

#include <gtest/gtest.h>

namespace skein::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(LeaveDeadline, BringForwardNeverPostponesIt) {
  const LeaveDeadline::Clock::time_point now;
  LeaveDeadline deadline;
  EXPECT_FALSE(deadline.is_set());
  deadline.bring_forward(seconds(10), now);
  deadline.bring_forward(seconds(2), now);
  deadline.bring_forward(seconds(8), now);
  EXPECT_EQ(deadline.left(now), seconds(2));
  deadline.set(seconds(8), now);
  EXPECT_EQ(deadline.left(now + seconds(1)), seconds(7));
  EXPECT_EQ(deadline.left(now + seconds(9)), seconds(0));
}

TEST(LeaveDeadline, DoesNotCountTimeInWhichTheLauncherWasStopped) {
  const LeaveDeadline::Clock::time_point now;
  LeaveDeadline deadline;
  deadline.excuse(seconds(100), milliseconds(200));
  EXPECT_FALSE(deadline.is_set());
  deadline.set(seconds(10), now);
  deadline.excuse(milliseconds(1500), milliseconds(200));  // so short a pause is normal on a busy machine
  EXPECT_EQ(deadline.left(now), seconds(10));
  deadline.excuse(seconds(60), milliseconds(200));
  EXPECT_EQ(deadline.left(now + seconds(60)), milliseconds(9800));
}

}  // namespace
}  // namespace skein::cli
