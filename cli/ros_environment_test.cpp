#include "cli/ros_environment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RunOptions options_for(const std::string& uav) {
  RunOptions options;
  options.ros_env = uav;
  options.domain = 40;
  return options;
}

/// The output of `command` in a shell that has evaluated the lines as a user does.
std::string evaluated(const RosPlace& place, const std::string& command) {
  const std::string script = "eval " + shell_word(shell_lines(place)) + "; " + command;
  FILE* const pipe = ::popen(script.c_str(), "r");
  std::string text;
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  EXPECT_EQ(::pclose(pipe), 0);
  return text;
}

TEST(RosEnvironment, HasTheDomainOfTheUav) {
  RunOptions options = options_for("jurong");
  EXPECT_EQ(ros_place(options).domain, 42);
  *options.ros_env = "raffles";
  EXPECT_EQ(ros_place(options).domain, 43);
  options.uavs = 8;  // beyond the scenario's fleet
  *options.ros_env = "jurong2";
  EXPECT_EQ(ros_place(options).domain, 47);
}

TEST(RosEnvironment, ForAnUnknownUavNamesTheUavsOfTheFleet) {
  try {
    ros_place(options_for("nobody"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no UAV 'nobody'; known are: jurong, raffles"));
  }
}

TEST(RosEnvironment, HasOnlyThePeersOfItsNetwork) {
  RunOptions options = options_for("jurong");
  options.network = "{usual: host, jurong: {peers: [uav-jurong, router.jurong]}, raffles: {peers: [other]}}";
  EXPECT_THAT(ros_place(options).peers, ElementsAre("uav-jurong", "router.jurong"));
  *options.ros_env = "sentosa";
  EXPECT_TRUE(ros_place(options).peers.empty());
}

TEST(RosEnvironment, CanBeEvaluatedByAShell) {
  const RosPlace place{.uav = "jurong", .domain = 42, .peers = {"10.0.0.2", "uav-jurong"}};
  EXPECT_EQ(evaluated(place, "echo $ROS_DOMAIN_ID"), "42\n");
  const std::string uri = evaluated(place, "printf '%s' \"$CYCLONEDDS_URI\"");
  EXPECT_THAT(uri, HasSubstr("<Peer address=\"10.0.0.2\"/><Peer address=\"uav-jurong\"/>"));
  EXPECT_EQ(evaluated(place, "sh -c 'echo ${ROS_DISCOVERY_SERVER-none}'"), "none\n");
}

}  // namespace
}  // namespace skein::cli
