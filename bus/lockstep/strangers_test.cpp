#include "bus/lockstep/strangers.hpp"

#include <gtest/gtest.h>

#include <set>

namespace skein::bus {
namespace {

const std::string kTopic = "rt/ada/command/trajectory";
const Strangers::IsStranger kAll = [](ParticipantId) { return true; };

TEST(Strangers, AreReportedOncePerTopicAndWriter) {
  Strangers strangers;
  for (std::uint64_t step = 5; step < 500; ++step) {
    strangers.add("ada", kTopic, 1, step);
    strangers.add("ada", kTopic, 2, step);
    strangers.add("ada", "rt/ada/command/gimbal", 1, step);
    EXPECT_EQ(strangers.take_notices(step, 20, kAll).size(), step == 25 ? 3U : 0U) << step;
  }
  EXPECT_EQ(strangers.unheard("ada"), 3U * 495U);
  EXPECT_EQ(strangers.unheard("bob"), 0U);
}

TEST(Strangers, AProgramThatJoinsInTimeIsNotAStranger) {
  Strangers strangers;
  std::set<ParticipantId> members;
  const auto is_stranger = [&](ParticipantId source) { return !members.contains(source); };
  strangers.add("ada", kTopic, 1, 0);
  strangers.add("ada", kTopic, 2, 0);
  EXPECT_TRUE(strangers.take_notices(19, 20, is_stranger).empty());
  members.insert(1);
  const auto notices = strangers.take_notices(20, 20, is_stranger);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(describe(notices[0]),
            "ada: samples on /ada/command/trajectory are ignored: the sender does not take part in the lock-step; see "
            "docs/ros2.md");
  EXPECT_EQ(strangers.unheard("ada"), 1U);  // the sample that the member sent before it joined is not counted
}

TEST(Strangers, AFloodOfWritersIsBounded) {
  Strangers strangers;
  for (ParticipantId source = 1; source <= 100'000; ++source) strangers.add("ada", kTopic, source, 0);
  EXPECT_EQ(strangers.take_notices(100, 20, kAll).size(), 256U);
  EXPECT_EQ(strangers.unheard("ada"), 100'000U);
}

}  // namespace
}  // namespace skein::bus
