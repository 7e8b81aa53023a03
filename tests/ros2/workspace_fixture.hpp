// Fixture for fleets with nodes of the packages in ros2/, which colcon builds once with the real ROS 2 of the tests. In
// the suite, build_test.cpp has built them before.
#pragma once

#include <sstream>

#include "ros2_fixture.hpp"

namespace skein::test {

/// Script with the arguments: the folder of ROS 2, the workspace, the source tree. It does not call colcon if the build
/// is newer than the sources, because colcon takes a while to find that there is nothing to do (with Make, a minute).
constexpr const char* kBuild = R"(
mkdir -p "$2"
exec 9>"$2.lock"
flock 9
built=$2/built
[[ ! -e $built || -n $(find "$3/ros2/" -newer "$built" -print -quit) ]] || exit 0
[[ -e $built ]] || rm -rf "$2"/*  # left by a build with another generator, for example Make
ln -sfn "$3/ros2" "$2/ros2"
touch "$built.since"
set +u
. "$1/env.sh" fastrtps 0
export CXXFLAGS=-O1 CCACHE_BASEDIR=$3 CMAKE_GENERATOR=Ninja
# With MAKEFLAGS, colcon does not make the build wait while the machine is busy (-l).
export MAKEFLAGS=-j$(nproc) CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
if command -v ccache >/dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
cd "$2"
colcon build --base-paths ros2 \
  --cmake-args -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 -DCMAKE_CXX_FLAGS_RELEASE=-O1
mv "$built.since" "$built"
)";

class WorkspaceTest : public Ros2Test {
 protected:
  void SetUp() override {
    Ros2Test::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (std::system("command -v colcon >/dev/null") != 0) GTEST_SKIP() << "no colcon: apt-get install colcon";
    static bool is_built = false;  // by an earlier test of this program
    if (is_built) return;
    ChildProcess& build =
        start_program("build", {"/bin/bash", "-euc", kBuild, "bash", build_path("ros2"), workspace(), source_path("")});
    const auto has_ended = [&] { return build.ended().has_value(); };
    ASSERT_TRUE(eventually(has_ended, std::chrono::minutes(15))) << "the packages take longer than any other test";
    ASSERT_EQ(build.wait().code, 0) << build.out() << build.err();
    is_built = true;
  }

  /// The folder in which colcon was called, with ros2/, build/, install/ and log/.
  std::string workspace() const { return build_path("colcon"); }
  std::string installed(const std::string& package) const { return workspace() + "/install/" + package; }
  /// The command with the workspace set up, for a shell in which ROS 2 is set up.
  std::string with_workspace(const std::string& command) const {
    return "bash -c '. " + workspace() + "/install/setup.sh; exec " + command + "'";
  }

  /// A run whose launcher has the workspace set up, with one middleware for its nodes.
  SkeinRun& run_with(const std::string& middleware, const std::string& name, const Arguments& arguments,
                     int exit_code = 0, Environment more = {}) {
    more.merge(ros_environment(middleware));
    return run(name, arguments, more, exit_code);
  }
  SkeinRun& start_with(const std::string& middleware, const std::string& name, const Arguments& arguments) {
    return start(name, arguments, ros_environment(middleware));
  }
  std::string log_of(const SkeinRun& run, const std::string& uav = "jurong") const {
    return text_of(run.dir() / ("uav_agent-" + uav + ".log"));
  }

  /// Variables of a shell after the setup files. @param setup  setup file of the workspace; empty: only that of ROS 2
  Environment ros_environment(const std::string& middleware, const std::string& setup = "setup.sh") {
    const std::string file = setup.empty() ? "/dev/null" : workspace() + "/install/" + setup;
    ChildProcess& shell = start_program(
        "environment-" + middleware, {"/bin/bash", "-c", ". \"$1/env.sh\" \"$2\" 0; . \"$3\"; LD_PRELOAD= env", "bash",
                                      build_path("ros2"), middleware, file});
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
