#include "recording/choice.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/topics.hpp"

namespace skein::recording {
namespace {

constexpr Scope kScopes[] = {Scope::none, Scope::messages, Scope::run, Scope::all, Scope::clouds};

std::string ros_name(const topics::TopicInfo& info, const std::string& id) {
  return topics::wire(info, id).name.substr(2);
}

TEST(RecordingChoice, AWiderScopeLosesNothing) {
  for (const topics::TopicInfo& info : topics::uav_topics()) {
    const std::string topic = ros_name(info, "jurong");
    bool before = false, unread_before = false;
    for (const Scope scope : kScopes) {
      const auto choice = choice_of(scope, "jurong", topic);
      EXPECT_TRUE(!before || choice) << topic;
      EXPECT_TRUE(!unread_before || choice->also_unread) << topic;
      before = choice.has_value();
      unread_before = choice && choice->also_unread;
    }
  }
}

TEST(RecordingChoice, AllCommandsAreRecordedAndCloudsOnlyOnRequest) {
  for (const topics::TopicInfo& info : topics::uav_topics()) {
    const std::string topic = ros_name(info, "jurong");
    if (info.direction == topics::Direction::from_agent) {
      EXPECT_EQ(choice_of(Scope::run, "jurong", topic)->period, 0) << topic;
    }
    if (info.cloud == &topics::kScanLayout || info.pattern == topics::kLidarServo.pattern) {
      EXPECT_FALSE(choice_of(Scope::run, "jurong", topic)) << topic;
      EXPECT_FALSE(choice_of(Scope::all, "jurong", topic)->also_unread) << topic;
      EXPECT_TRUE(choice_of(Scope::clouds, "jurong", topic)->also_unread) << topic;
    }
  }
}

TEST(RecordingChoice, DomainsDoNotShareANameInTheRecording) {
  std::set<std::string> names;
  for (const std::string& node : std::vector<std::string>{"jurong", "raffles", "gcs"}) {
    for (const std::string& topic : std::vector<std::string>{"/clock", "/plan", "/" + node + "/gimbal"}) {
      EXPECT_TRUE(names.insert(recorded_topic(node, topic)).second) << node << topic;
    }
  }
  EXPECT_TRUE(names.contains("/jurong/gimbal"));
  EXPECT_EQ(recorded_topic("", "/skein/ledger"), "/skein/ledger");
}

TEST(RecordingChoice, ReadsTheNamesOfScopes) {
  EXPECT_EQ(scope_of("clouds"), Scope::clouds);
  EXPECT_THROW(scope_of("everything"), InputError);
}

}  // namespace
}  // namespace skein::recording
