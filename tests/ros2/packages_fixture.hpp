// Fixture for ROS 2 nodes that observe a fleet with message types that the tests' ROS 2 lacks. The types are built
// once, from Skein's IDL. In the suite, build_test.cpp has built them before.
#pragma once

#include "ros2_fixture.hpp"

namespace skein::test {

class ExtraMessagesTest : public Ros2Test {
 protected:
  void SetUp() override {
    Ros2Test::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    static bool is_built = false;  // by an earlier test of this program
    if (is_built) return;
    ChildProcess& probe = start_node("empy", "cyclonedds", 1, "", "python3 -c 'import em'");
    if (probe.wait().code != 0) {
      GTEST_SKIP() << "ROS 2 cannot build messages here: python3-empy is missing (apt-get install python3-empy): "
                   << probe.err();
    }
    ChildProcess& build = start_node("build", "cyclonedds", 1, "",
                                     "flock " + packages_ + ".lock python3 " +
                                         source_path("tests/ros2/message_packages.py") + " " + source_path("idl") +
                                         " " + packages_ + " tf2_msgs visualization_msgs diagnostic_msgs octomap_msgs");
    ASSERT_EQ(build.wait().code, 0) << build.err();
    is_built = true;
  }

  /// Starts the command in a shell in which ROS 2 knows these types.
  ChildProcess& start_looker(const std::string& middleware, int domain, const std::string& command) {
    return start_node(middleware, middleware, domain, "",
                      "env PYTHONPATH=$(echo " + packages_ + "/local/lib/python3*/dist-packages):$PYTHONPATH " +
                          "LD_LIBRARY_PATH=" + packages_ + "/lib:$LD_LIBRARY_PATH AMENT_PREFIX_PATH=" + packages_ +
                          ":$AMENT_PREFIX_PATH " + command);
  }

 private:
  const std::string packages_ = build_path("ros2_packages");
};

}  // namespace skein::test
