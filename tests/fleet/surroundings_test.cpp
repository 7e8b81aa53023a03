// What a fleet finds around it, other fleets and the user's environment, does not reach into its run.
#include <signal.h>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class Surroundings : public FleetTest {
 protected:
  Surroundings() : scenario_(write_small_scene(folder())) {}

  /// A fleet that waits for one of its agents, with a temporary folder of its own.
  SkeinRun& waiting_fleet(const std::string& name, const Arguments& more = {}) {
    fs::create_directories(folder() / (name + ".tmp"));
    Arguments arguments = {scenario_, "--planner", "hover", "--debug", "changi"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(name, arguments, {{"TMPDIR", folder() / (name + ".tmp")}});
  }

  std::string scenario_;
};

TEST_F(Surroundings, FleetsWithDifferentTemporaryFoldersTakeDifferentDomains) {
  SkeinRun& a = waiting_fleet("a");
  ASSERT_TRUE(a.wait_for("gdb --args")) << a.err();
  SkeinRun& b = waiting_fleet("b");
  ASSERT_TRUE(b.wait_for("gdb --args")) << b.err();
  const auto [first_a, last_a] = a.domains();
  const auto [first_b, last_b] = b.domains();
  EXPECT_TRUE(last_a < first_b || last_b < first_a) << first_a << ".." << last_a << " and " << first_b << ".." << last_b;

  SkeinRun& c = waiting_fleet("c", {"--domain", std::to_string(last_a)});
  EXPECT_EQ(c.exit_code(), 2);
  EXPECT_NE(c.err().find("uses domain " + std::to_string(last_a) + " (process " + std::to_string(a.skein().pid()) + ")"),
            std::string::npos)
      << c.err();
  for (SkeinRun* run : {&a, &b}) {
    run->skein().signal(SIGINT);
    EXPECT_EQ(run->exit_code(), 130) << run->err();
  }
}

}  // namespace
}  // namespace skein::test
