// The packages of ros2/, built once with the real ROS 2 of the tests, and fleets with their nodes.
#pragma once

#include <sstream>

#include "ros2_fixture.hpp"

namespace skein::test {

class WorkspaceTest : public Ros2Test {
 protected:
  void SetUp() override {
    Ros2Test::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    ChildProcess& build =
        start_program("build", {"/bin/bash", "-c",
                                "exec 9>\"$2.lock\"; flock 9; . \"$1/env.sh\" fastrtps 0; export CXXFLAGS=-O1; "
                                "if command -v ccache >/dev/null; then export CMAKE_C_COMPILER_LAUNCHER=ccache "
                                "CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi; exec \"$3/ros2/build.sh\" \"$2\"",
                                "bash", build_path("ros2"), workspace(), source_path("")});
    const auto is_built = [&] { return build.ended().has_value(); };
    ASSERT_TRUE(eventually(is_built, std::chrono::minutes(15))) << "the packages take longer than any other test";
    ASSERT_EQ(build.wait().code, 0) << build.out() << build.err();
  }

  std::string workspace() const { return build_path("ros2_workspace"); }

  /// A run whose launcher has the workspace set up, with one middleware for its nodes.
  SkeinRun& run_with(const std::string& middleware, const std::string& name, const Arguments& arguments,
                     int exit_code = 0, Environment more = {}) {
    more.merge(environment(middleware));
    return run(name, arguments, more, exit_code);
  }
  std::string log_of(const SkeinRun& run, const std::string& uav = "jurong") const {
    return text_of(run.dir() / ("uav_agent-" + uav + ".log"));
  }

 private:
  /// What a shell has after the setup files.
  Environment environment(const std::string& middleware) {
    ChildProcess& shell = start_program(
        "environment-" + middleware, {"/bin/bash", "-c", ". \"$1/env.sh\" \"$2\" 0; . \"$3/setup.sh\"; LD_PRELOAD= env",
                                      "bash", build_path("ros2"), middleware, workspace()});
    EXPECT_EQ(shell.wait().code, 0) << shell.err();
    Environment variables;
    std::istringstream lines(shell.out());
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find('=');
      for (const char* name : {"AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "PATH", "PYTHONPATH", "RMW_IMPLEMENTATION"}) {
        if (line.substr(0, equals) == name) variables[name] = line.substr(equals + 1);
      }
    }
    // This ROS 2 is linked to one middleware; preloading another chooses it.
    variables["LD_PRELOAD"] = build_path("ros2") + "/lib/librmw_" + middleware + "_cpp.so";
    return variables;
  }
};

}  // namespace skein::test
