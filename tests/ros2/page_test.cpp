// The commands of the pages about ROS 2 that need one, typed as their reader would: those whose comment says so. A
// fleet that a block starts in the background is flying before the next line is typed, as when a reader looks at it.
#include <signal.h>

#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "process/host/host_lock.hpp"
#include "tests/howto/page_test.hpp"
#include "tests/support/places.hpp"
#include "workspace_fixture.hpp"

namespace skein::test {
namespace {

constexpr const char* kTyped = "needs ROS 2; tests/ros2 types it";
constexpr const char* kReadersRos = "source /opt/ros/humble/setup.bash\n";  // every shell here has another one set up
const std::regex kBackground(R"((\./skein .*) &)");

/// A page, and how many of its blocks are typed at least.
using Page = std::pair<const char*, int>;

class RosPageTyped : public WorkspaceTest, public testing::WithParamInterface<Page> {
 protected:
  void SetUp() override {
    WorkspaceTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    const auto is_ours = [&] { return (lock_ = HostLock::try_take("skein " + workspace())).has_value(); };
    ASSERT_TRUE(eventually(is_ours, std::chrono::minutes(15))) << "another test reads pages in " << workspace();
    const std::set<std::filesystem::path> colcons = {"ros2", "build", "install", "log", "built"};
    for (const auto& entry : std::filesystem::directory_iterator(checkout())) {  // of another reader
      if (!colcons.contains(entry.path().filename())) std::filesystem::remove_all(entry);
    }
    std::filesystem::create_symlink(program("skein"), checkout() / "skein");
    std::filesystem::create_directory_symlink(source_path("config"), checkout() / "config");
  }

  /// The reader's folder is the workspace, so colcon finds that all is built.
  std::filesystem::path checkout() const { return workspace(); }

  /// A shell in the reader's folder that has ROS 2 set up, and the workspace once the page has built it.
  ChildProcess& shell(const std::string& text) {
    const std::string name = "typed-" + std::to_string(++shells_);
    const auto script = write(name + ".sh", (is_built_ ? "source install/setup.bash\n" : "") + text);
    Environment variables = ros_environment("cyclonedds", "");
    variables["SKEIN_DURATION"] = std::to_string(kMission_s);
    return start_program(
        name,
        {"/bin/bash", "-c", "cd '" + checkout().string() + "' && exec bash -e '" + script.string() + "' </dev/null"},
        variables);
  }

  /// @returns a shell that flies a fleet, once it flies. Its domains are free ones, whatever the page says.
  ChildProcess& fly(const std::string& command) {
    ChildProcess& fleet = shell("exec " + std::regex_replace(command, std::regex(R"( --domain \d+)"), "") + "\n");
    const auto flies = [&] {
      const std::string said = fleet.err();
      std::smatch match;
      return std::regex_search(said, match, std::regex("results in (\\S+)")) && is_flying(checkout() / match.str(1));
    };
    EXPECT_TRUE(eventually(flies)) << fleet.err();
    return fleet;
  }

  static constexpr int kMission_s = 20;  ///< of fleets that are waited for
  bool is_built_ = false;

 private:
  int shells_ = 0;
  std::optional<HostLock> lock_;  ///< of the reader's folder
};

/// The page's domains, 40 and above, as those of a fleet.
std::string with_domains_of(const ChildProcess& fleet, const std::string& text) {
  const std::string said = fleet.err();
  std::smatch match;
  if (!std::regex_search(said, match, std::regex(R"(DDS domains (\d+)\.\.)"))) return text;
  const int jurong = std::stoi(match[1]) + 2;
  return std::regex_replace(text, std::regex("ROS_DOMAIN_ID=42"), "ROS_DOMAIN_ID=" + std::to_string(jurong));
}

TEST_P(RosPageTyped, IsFollowed) {
  int followed = 0;
  for (const PageBlock& block : blocks_of(source_path(GetParam().first))) {
    if (block.is_file()) std::ofstream(checkout() / block.name) << block.text;
    if (block.note("not run") != kTyped || HasFailure()) continue;
    SCOPED_TRACE("line " + std::to_string(block.line));
    ++followed;
    ChildProcess* fleet = nullptr;
    std::string typed;
    std::istringstream lines(std::regex_replace(block.text, std::regex(kReadersRos), ""));
    for (std::string line; std::getline(lines, line);) {
      std::smatch match;
      if (std::regex_match(line, match, kBackground)) {
        fleet = &fly(match.str(1) + " --duration 3000");
      } else {
        typed += line + "\n";
      }
    }
    if (fleet != nullptr) typed = with_domains_of(*fleet, typed);
    ChildProcess& reader = shell(typed);
    // A node ends when its reader ends it, here when its fleet has heard it.
    if (typed.find("climber.py") != std::string::npos) {
      const auto flies = [&] {
        for (const auto& row : read_csv(checkout() / "runs/nodes/trajectories.csv", LastLine::may_be_unfinished)) {
          if (row.at("uav") == "jurong" && std::stod(row.at("z")) > 5.0) return true;
        }
        return reader.ended().has_value();
      };
      EXPECT_TRUE(eventually(flies)) << reader.err();
      EXPECT_FALSE(reader.ended()) << reader.err();
      ::kill(-reader.pid(), SIGINT);
      reader.wait();
    } else {
      EXPECT_TRUE(eventually([&] { return reader.ended().has_value(); })) << typed;
      EXPECT_EQ(reader.wait().code, 0) << typed << reader.out() << reader.err();
    }
    is_built_ = is_built_ || typed.find("colcon build") != std::string::npos;
    if (fleet == nullptr) continue;
    fleet->signal(SIGINT);
    fleet->wait();
  }
  EXPECT_GE(followed, GetParam().second);
  EXPECT_TRUE(is_built_);
}

INSTANTIATE_TEST_SUITE_P(Pages, RosPageTyped,
                         testing::Values(Page("docs/ros2.md", 5), Page("docs/porting-from-caric.md", 2)),
                         [](const auto& page) { return page.index == 0 ? "ros2" : "porting"; });

}  // namespace
}  // namespace skein::test
