// Fixture for fleets with real ROS 2 nodes beside them; skips a test if there is no ROS 2 (SKEIN_ROS2).
#pragma once

#include <cstdlib>
#include <optional>

#include "fleet_fixture.hpp"
#include "process/host/host_lock.hpp"
#include "tests/support/places.hpp"

namespace skein::test {

/// Its fleets fly in DDS domains that belong to this test program. A node may outlive its fleet for a moment, so in
/// other domains it could disturb the next fleet.
class Ros2Test : public FleetTest {
 protected:
  SkeinRun& start(const std::string& name, const Arguments& arguments, const Environment& environment = {}) {
    return FleetTest::start(name, joined(arguments, {"--domain", first_domain()}), environment);
  }
  SkeinRun& run(const std::string& name, const Arguments& arguments, const Environment& environment = {},
                int exit_code = 0) {
    return FleetTest::run(name, joined(arguments, {"--domain", first_domain()}), environment, exit_code);
  }

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

  /// Starts the command in a shell with ROS 2 set up. @param localhost  further argument of env.sh; empty: its defaults
  ChildProcess& start_node(const std::string& name, const std::string& middleware, int domain,
                           const std::string& localhost, const std::string& command) {
    const std::string shell = ". " + build_path("ros2") + "/env.sh " + middleware + " " + std::to_string(domain) + " " +
                              localhost + "; exec " + command;
    return start_program(name, {"/bin/bash", "-c", shell}, {{"ROS_LOG_DIR", folder() / "ros"}});
  }

  /// First domain of a block that no other test program has: far from the lowest free domains, which fleets take by
  /// default, and below those with ephemeral ports (from 102 on). @throws std::runtime_error after a timeout
  static std::string first_domain() {
    static std::optional<HostLock> block;
    static int first = 0;
    const auto has_block = [] {
      for (first = 94; !block && first >= 62; first -= 8) {
        if ((block = HostLock::try_take("skein tests: domains from " + std::to_string(first)))) break;
      }
      return block.has_value();
    };
    if (!block && !eventually(has_block, std::chrono::minutes(15))) throw std::runtime_error("all domains are taken");
    return std::to_string(first);
  }

  std::string file(const std::string& name) const { return folder() / (name + ".json"); }
  bool ready(const std::string& name) const { return std::filesystem::exists(file(name) + ".ready"); }

  /// Starts the agent that the fleet waits for, by the command that the launcher printed.
  ChildProcess& start_agent(const SkeinRun& run) {
    return start_program("agent", {"/bin/sh", "-c", run.debug_command()});
  }
};

}  // namespace skein::test
