// The end of a node's process at the end of the run. Needs no ROS 2.
#include "ros2/skein_ros/src/step/leaving.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace skein_ros {
namespace {

/// Ends this process as a node in C++ does: its main() returns after the handler of rclcpp has ended spin().
[[noreturn]] void return_from_main(int code) {
  std::signal(SIGTERM, [](int) {});
  end_node();
  std::exit(code);
}

TEST(RosNodeAtTheEndOfTheRun, KeepsTheExitCodeOfItsMainFunction) {
  ::unsetenv("ROS_SECURITY_ENABLE");
  for (const int code : {0, 1, 2, 77}) EXPECT_EXIT(return_from_main(code), testing::ExitedWithCode(code), "");
}

TEST(RosNodeAtTheEndOfTheRun, KeepsItsExitCodeInASecuredFleet) {
  for (const int code : {0, 1, 2}) {
    const auto end = [&] {
      ::setenv("ROS_SECURITY_ENABLE", "true", 1);  // in the process of this node only
      return_from_main(code);
    };
    EXPECT_EXIT(end(), testing::ExitedWithCode(code), "");
  }
}

TEST(RosNodeAtTheEndOfTheRun, EndsAtOnceWithoutAHandler) {
  const auto end = [] {
    std::signal(SIGTERM, SIG_DFL);
    end_node();
    std::exit(1);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace skein_ros
