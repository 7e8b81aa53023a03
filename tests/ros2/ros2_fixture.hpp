// Fleets with real ROS 2 nodes beside them; skipped where there is no ROS 2 (SKEIN_ROS2).
#pragma once

#include <cstdlib>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {

class Ros2Test : public FleetTest {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("SKEIN_ROS2");
    if (folder == nullptr || *folder == '\0') GTEST_SKIP() << "no ROS 2: SKEIN_ROS2 is not set";
    static bool is_there = false;  // seen by an earlier test of this program
    if (is_there) return;
    ChildProcess& unpack = start_program(
        "unpack", {"/bin/sh", "-c", "exec 9>\"$2.lock\"; flock 9; test -e \"$2/env.sh\" || \"$1/unpack.sh\" \"$2\"",
                   "sh", folder, build_path("ros2")});
    ASSERT_EQ(unpack.wait().code, 0) << unpack.err();
    ChildProcess& probe = start_node("probe", "cyclonedds", 1, "", "python3 -c 'import rclpy, numpy, yaml'");
    if (probe.wait().code != 0) GTEST_SKIP() << "no ROS 2: its packages are missing (packages.txt): " << probe.err();
    is_there = true;
  }

  /// A shell in which ROS 2 runs, with default settings unless `localhost`.
  ChildProcess& start_node(const std::string& name, const std::string& middleware, int domain,
                           const std::string& localhost, const std::string& command) {
    const std::string shell = ". " + build_path("ros2") + "/env.sh " + middleware + " " + std::to_string(domain) + " " +
                              localhost + "; exec " + command;
    return start_program(name, {"/bin/bash", "-c", shell}, {{"ROS_LOG_DIR", folder() / "ros"}});
  }

  std::string file(const std::string& name) const { return folder() / (name + ".json"); }
  bool ready(const std::string& name) const { return std::filesystem::exists(file(name) + ".ready"); }

  /// The agent for which the fleet has waited, by the command that the launcher printed.
  ChildProcess& start_agent(const SkeinRun& run) {
    return start_program("agent", {"/bin/sh", "-c", run.debug_command()});
  }
};

}  // namespace skein::test
