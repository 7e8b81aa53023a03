#include "sim_server/pace.hpp"

#include <gtest/gtest.h>

namespace skein::sim {
namespace {

using view::TimeOrder;
using Kind = TimeOrder::Kind;
using std::chrono::milliseconds;

constexpr double kExchange_s = 0.05;

class PaceTest : public testing::Test {
 protected:
  /// Asks every millisecond for this time whether an exchange may begin. @returns how many exchanges began.
  int exchanges(int ms) {
    int count = 0;
    for (int i = 0; i < ms; ++i, now_ += milliseconds(1)) count += pace_.may_go_on(now_, kExchange_s) ? 1 : 0;
    return count;
  }

  Pace pace_{2.0};
  Pace::Clock::time_point now_{std::chrono::hours(1)};
};

TEST_F(PaceTest, TheRunKeepsTheSpeed) {
  EXPECT_EQ(exchanges(1000), 40) << "2 s in a second, of 0.05 s each";
  EXPECT_NEAR(pace_.held_s(now_), 1.0, 0.07) << "exchanges take no time here, and the test notices each hold 1 ms late";
}

TEST_F(PaceTest, WithoutASpeedLimitTheRunIsNeverHeld) {
  pace_.obey({Kind::speed, std::nullopt});
  EXPECT_EQ(exchanges(100), 100);
  EXPECT_EQ(pace_.held_s(now_), 0.0);
}

TEST_F(PaceTest, APausedRunStandsStillUntilItIsResumed) {
  EXPECT_EQ(exchanges(100), 4);
  pace_.obey({Kind::pause});
  EXPECT_TRUE(pace_.paused());
  EXPECT_EQ(exchanges(60'000), 0);
  EXPECT_GT(pace_.left(now_), Pace::Clock::duration(0));
  pace_.obey({Kind::resume});
  EXPECT_EQ(exchanges(1), 1) << "at once";
  EXPECT_GT(pace_.held_s(now_), 60.0);
  EXPECT_EQ(exchanges(1000), 40) << "the time of the pause is not made up for";
}

TEST_F(PaceTest, APauseThatLastsCountsAsHeldTime) {
  EXPECT_EQ(exchanges(1), 1);
  pace_.obey({Kind::pause});
  EXPECT_EQ(exchanges(60'000), 0);
  EXPECT_DOUBLE_EQ(pace_.held_s(now_), 60.0);
}

TEST_F(PaceTest, ARunThatIsLetGoIsNotHeldAlthoughItIsPaused) {
  pace_.obey({Kind::pause});
  EXPECT_EQ(exchanges(1000), 0);
  pace_.let_go(now_);
  now_ += std::chrono::seconds(60);
  EXPECT_DOUBLE_EQ(pace_.held_s(now_), 1.0);
  EXPECT_EQ(exchanges(1000), 0);
  EXPECT_DOUBLE_EQ(pace_.held_s(now_), 2.0);
}

TEST(Pace, TheRunPausesOnceAtItsPauseTime) {
  Pace pace(std::nullopt, 12.0);
  EXPECT_FALSE(pace.reach(0.0) || pace.reach(11.95) || pace.paused());
  EXPECT_TRUE(pace.reach(12.0));
  EXPECT_TRUE(pace.paused());
  EXPECT_FALSE(pace.reach(12.0)) << "asked again and again while it pauses";
  pace.obey({Kind::resume});
  EXPECT_FALSE(pace.reach(12.0) || pace.reach(12.05) || pace.paused());
  Pace between(2.0, 12.01);
  EXPECT_FALSE(between.reach(12.0));
  EXPECT_TRUE(between.reach(12.05)) << "the first boundary from then on";
  EXPECT_FALSE(Pace(2.0).reach(1e6));
}

TEST_F(PaceTest, AStepIsOneExchange) {
  pace_.obey({Kind::step});
  EXPECT_EQ(exchanges(1000), 0) << "a request for one step pauses a run that goes on";
  pace_.obey({Kind::step});
  EXPECT_EQ(pace_.left(now_), Pace::Clock::duration(0));
  EXPECT_EQ(exchanges(1000), 1);
  pace_.obey({Kind::step});
  pace_.obey({Kind::step});
  EXPECT_EQ(exchanges(1000), 2);
  EXPECT_TRUE(pace_.paused());
}

TEST_F(PaceTest, TheRunCatchesUpOnlyALittleOfALongDelay) {
  EXPECT_EQ(exchanges(100), 4);
  now_ += std::chrono::seconds(10);  // one exchange took 10 s
  EXPECT_LE(exchanges(1000), 40 + 11);
  EXPECT_EQ(exchanges(1000), 40);
}

TEST_F(PaceTest, AnotherSpeedTakesEffectAtOnce) {
  pace_.obey({Kind::speed, 0.1});
  EXPECT_EQ(exchanges(1), 1);
  EXPECT_EQ(exchanges(400), 0) << "the next is due after half a second";
  pace_.obey({Kind::speed, 20.0});
  EXPECT_EQ(exchanges(1000), 400);
}

}  // namespace
}  // namespace skein::sim
