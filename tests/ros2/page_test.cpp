// Executes the commands on pages that need ROS 2: the blocks whose comment says so. If a block starts a fleet in the
// background, the test waits until it flies before it executes the next line.
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
constexpr const char* kReadersRos =
    "source /opt/ros/humble/setup.bash\n";  // not executed, because these shells have set up another ROS 2
const std::regex kBackground(R"((\./skein .*) &)");

/// A page, and the least number of its blocks that must be executed.
using Page = std::pair<const char*, int>;

class RosPageTyped : public WorkspaceTest, public testing::WithParamInterface<Page> {
 protected:
  void SetUp() override {
    WorkspaceTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    const auto is_ours = [&] { return (lock_ = HostLock::try_take("skein " + workspace())).has_value(); };
    ASSERT_TRUE(eventually(is_ours, std::chrono::minutes(15))) << "another test still follows pages in " << workspace();
    const std::set<std::filesystem::path> colcons = {"ros2", "build", "install", "log", "built"};
    for (const auto& entry : std::filesystem::directory_iterator(checkout())) {  // files of an earlier test
      if (!colcons.contains(entry.path().filename())) std::filesystem::remove_all(entry);
    }
    std::filesystem::create_symlink(program("skein"), checkout() / "skein");
    std::filesystem::create_directory_symlink(source_path("config"), checkout() / "config");
  }

  /// The reader's folder is the workspace of the tests, in which everything is built already.
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

  /// Starts a fleet in free domains, instead of the page's. @returns its shell, once the fleet flies.
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

  static constexpr int kMission_s = 20;  ///< mission time of fleets whose end the test awaits [s]
  bool is_built_ = false;

 private:
  int shells_ = 0;
  std::optional<HostLock> lock_;  ///< for the reader's folder
};

/// Replaces the page's domain of jurong, 42, with that of a fleet.
std::string with_domains_of(const ChildProcess& fleet, const std::string& text) {
  const std::string said = fleet.err();
  std::smatch match;
  if (!std::regex_search(said, match, std::regex(R"(DDS domains (\d+)\.\.)"))) return text;
  const int jurong = std::stoi(match[1]) + 2;
  return std::regex_replace(text, std::regex("ROS_DOMAIN_ID=42"), "ROS_DOMAIN_ID=" + std::to_string(jurong));
}

TEST_P(RosPageTyped, HasCommandsThatSucceed) {
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
    // Readers of the page end the node themselves; the test ends it when the fleet has received its commands.
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
                         testing::Values(Page("docs/how-to-ros2.md", 5), Page("docs/porting-from-caric.md", 2)),
                         [](const auto& page) { return page.index == 0 ? "ros2" : "porting"; });

}  // namespace
}  // namespace skein::test
