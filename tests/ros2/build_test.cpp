// Builds what the other tests of this folder need, once: the packages in ros2/, and the messages that the tests' ROS 2
// lacks. If each test built them on demand, several CTest entries would wait at the same time for one build.
#include <filesystem>

#include "packages_fixture.hpp"
#include "workspace_fixture.hpp"

namespace skein::test {
namespace {

TEST_F(WorkspaceTest, HasAllPackages) {
  for (const char* const package : {"skein_msgs", "skein_ros", "skein_ros_baseline", "skein_ros_examples"}) {
    EXPECT_TRUE(std::filesystem::exists(installed(package) + "/share/" + package + "/package.xml")) << package;
  }
}

// SetUp() builds the messages, and fails if the build fails.
TEST_F(ExtraMessagesTest, AreBuiltFromTheIdl) { EXPECT_TRUE(std::filesystem::exists(build_path("ros2_packages"))); }

}  // namespace
}  // namespace skein::test
