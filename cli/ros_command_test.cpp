#include "run/ros_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/ros_environment.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Creates install prefixes as colcon makes them, and lists them in AMENT_PREFIX_PATH.
class RosPrefixes : public testing::Test {
 protected:
  RosPrefixes() {
    if (const char* const former = std::getenv("AMENT_PREFIX_PATH")) former_ = former;
    ::unsetenv("AMENT_PREFIX_PATH");
  }
  ~RosPrefixes() override {
    former_ ? ::setenv("AMENT_PREFIX_PATH", former_->c_str(), 1) : ::unsetenv("AMENT_PREFIX_PATH");
  }

  fs::path prefix(const std::string& name) const { return scratch_.path() / name; }
  void put(const fs::path& file) const {
    fs::create_directories(file.parent_path());
    write_script(file, "");
  }
  void use(const std::string& prefixes) const { ::setenv("AMENT_PREFIX_PATH", prefixes.c_str(), 1); }
  static std::string refusal(const std::string& spec) {
    try {
      ros_command(spec);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  const ScratchDir scratch_;
  std::optional<std::string> former_;
};

TEST_F(RosPrefixes, PlannersAndShellsUseTheFirstPrefixWithTheStepLibrary) {
  put(prefix("begun") / "share/skein_ros/fastdds_udp.xml");  // colcon has not built the library yet
  for (const char* name : {"one", "other"}) {
    put(prefix(name) / "lib/libskein_step.so");
    put(prefix(name) / "share/skein_ros/fastdds_udp.xml");
  }
  put(prefix("mine") / "lib/mine/node");
  use(prefix("begun").string() + "::" + prefix("mine").string() + ":" + prefix("one").string() + ":" +
      prefix("other").string());
  EXPECT_EQ(skein_ros_prefix(), prefix("one"));
  const std::string command = ros_command("ros:mine/node").value_or("");
  EXPECT_THAT(command, HasSubstr((prefix("one") / "lib/libskein_step.so").string()));
  const std::string lines = shell_lines({.uav = "jurong", .domain = 42});
  for (const std::string& text : {command, lines}) {
    EXPECT_THAT(text, HasSubstr((prefix("one") / "share/skein_ros/fastdds_udp.xml").string()));
    EXPECT_THAT(text, Not(HasSubstr(prefix("begun").string())));
  }
}

TEST_F(RosPrefixes, WithoutSkeinRosAPlannerIsRefusedAndAShellHasNoProfile) {
  EXPECT_THAT(refusal("ros:mine/node"), HasSubstr("AMENT_PREFIX_PATH is not set"));
  use(":");
  EXPECT_THAT(refusal("ros:mine/node"), HasSubstr("AMENT_PREFIX_PATH is not set"));
  put(prefix("mine") / "lib/mine/node");
  put(prefix("mine") / "share/skein_ros/fastdds_udp.xml");
  use(prefix("mine"));
  EXPECT_THAT(refusal("ros:mine/node"), HasSubstr("has no package skein_ros"));
  EXPECT_EQ(skein_ros_prefix(), std::nullopt);
  EXPECT_THAT(shell_lines({.uav = "jurong", .domain = 42}), HasSubstr("unset FASTRTPS_DEFAULT_PROFILES_FILE"));
}

}  // namespace
}  // namespace skein::cli
