// `skein ps` and `skein attach`: into a fleet that is already flying.
#include "debug_fixture.hpp"

namespace skein::test {
namespace {

class Attach : public DebugTest {
 protected:
  SkeinRun& flying_fleet() {
    SkeinRun& fleet = start("fleet", {scenario_, "--planner", "patrol", "--duration", "600", "--no-oracle"});
    EXPECT_TRUE(fleet.wait_until_flying()) << fleet.err();
    return fleet;
  }
  static Arguments joined_words(Arguments words, const Arguments& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static void end(SkeinRun& fleet) {
    fleet.skein().signal(SIGINT);
    EXPECT_EQ(fleet.exit_code(), 130) << fleet.err();
    EXPECT_TRUE(fleet.result()["lost_members"].empty()) << fleet.result()["lost_members"];
  }
};

TEST_F(Attach, PsListsTheFleetAndItsPrograms) {
  SkeinRun& fleet = flying_fleet();
  const std::string text = skein({"ps"}).out();
  const std::size_t at = text.find(std::filesystem::path(fleet.dir()).filename().string() + ": scenario, simulated ");
  ASSERT_NE(at, std::string::npos) << text;
  expect_part(text, "launcher " + std::to_string(fleet.skein().pid()) + "\n");
  for (const auto& [program, pid] : processes_of(fleet.dir())) {
    if (program == "skein") continue;
    expect_part(text, "  " + program);
    expect_part(text, std::to_string(pid) + "  runs\n");
  }
  end(fleet);
}

TEST_F(Attach, GdbLooksIntoAFlyingProgramAndLeavesItFlying) {
  SKEIN_NEEDS_GDB();
  SkeinRun& fleet = flying_fleet();
  ChildProcess& gdb = typed("gdb", {"skein", "attach", "changi", "--run", fleet.dir()},
                            "break skein::agent::PatrolPlanner::plan\ncontinue\nprint in.state.p_WB\ndetach\nquit\n");
  EXPECT_EQ(gdb.wait().code, 0) << gdb.out() << gdb.err();
  expect_part(gdb.out(), "$1 = (");
  expect_part(gdb.err(), "the fleet waits for changi up to 60 s");
  expect_part(gdb.err(), "`break YourPlanner::plan`), then `continue`");
  end(fleet);
}

TEST_F(Attach, WhoeverLooksInAndGoesOnChangesNothing) {
  SKEIN_NEEDS_GDB();
  const Arguments flight = {scenario_, "--planner", "patrol", "--duration", "400", "--no-oracle"};
  SkeinRun& fleet = start("fleet", flight);
  ASSERT_TRUE(fleet.wait_until_flying()) << fleet.err();
  ChildProcess& gdb = typed("gdb", {"skein", "attach", "changi", "--run", fleet.dir()},
                            "break skein::agent::PatrolPlanner::plan\ncontinue\nprint in.tick\ndelete\ndetach\nquit\n");
  EXPECT_EQ(gdb.wait().code, 0) << gdb.out() << gdb.err();
  expect_part(gdb.out(), "$1 = ");
  EXPECT_EQ(fleet.exit_code(), 0) << fleet.err();
  EXPECT_EQ(fleet.digest(), run("plain", joined_words(flight, {"--one-process"})).digest());
}

// It has the same domains, which are others there.
TEST_F(Attach, AFleetInAnotherNetworkIsToldFromTheOneHere) {
  if (std::system("unshare --net true 2>/dev/null") != 0) GTEST_SKIP() << "no network namespaces here: not root";
  SkeinRun& fleet = flying_fleet();
  const std::string there = dir("there");
  ChildProcess& other = start_program(
      "there", {"/usr/bin/env", "unshare", "--net", "/bin/sh", "-c", "ip link set lo up && exec \"$0\" \"$@\"",
                program("skein"), "run", scenario_, "--planner", "patrol", "--duration", "600", "--no-oracle",
                "--domain", std::to_string(fleet.domains().first), "--out", there});
  ASSERT_TRUE(eventually([&] { return is_flying(there); })) << other.err();
  const std::string text = skein({"ps"}).out();
  const std::string launcher = "launcher " + std::to_string(fleet.skein().pid());
  const std::size_t first = text.find(launcher);
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find(launcher, first + 1), std::string::npos) << text;
  expect_part(text, ", in another network namespace\n");
  const auto attached = [&](const Arguments& more) {
    Arguments words = {"attach", "changi=echo"};
    words.insert(words.end(), more.begin(), more.end());
    ChildProcess& echo = skein(words);
    EXPECT_EQ(echo.wait().code, 0) << echo.err();
    return std::stoi(echo.out());
  };
  EXPECT_EQ(attached({}), processes_of(fleet.dir()).at("uav_agent-changi")) << "the one here, without a question";
  EXPECT_EQ(attached({"--run", there}), processes_of(there).at("uav_agent-changi"));
  other.signal(SIGINT);
  EXPECT_EQ(other.wait().code, 130) << other.err();
  end(fleet);
}

TEST_F(Attach, WhoIsNotThereIsBadInput) {
  EXPECT_EQ(skein({"attach", "changi", "--run", folder()}).wait().code, 2);
  SkeinRun& fleet = flying_fleet();
  ChildProcess& wrong = skein({"attach", "chang", "--run", fleet.dir()});
  EXPECT_EQ(wrong.wait().code, 2);
  expect_part(wrong.err(), "changi");
  end(fleet);
}

}  // namespace
}  // namespace skein::test
