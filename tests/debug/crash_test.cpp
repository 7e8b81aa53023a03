// The files that a crashed program leaves, and the log of agents.
#include <spdlog/fmt/fmt.h>

#include <random>
#include <regex>

#include "core/files/command_file.hpp"
#include "debug_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class Crash : public DebugTest {
 protected:
  Arguments flight(const Arguments& more = {}) const {
    Arguments words = {scenario_, "--agent", helper_program("crash_agent"), "--duration", "5", "--no-oracle"};
    if (!std::ranges::count(more, "--planner")) words.insert(words.end(), {"--planner", "hover,changi=crash"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::size_t crashing_line() {
    const std::string text = text_of(source_path("tests/debug/crash_planner.cpp"));
    return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + text.find("// HERE"), '\n'));
  }
};

TEST_F(Crash, TheBacktraceNamesTheLine) {
  SkeinRun& crashed = run("crash", flight(), {}, 3);
  const std::string log = text_of(crashed.dir() / "uav_agent-changi.log");
  expect_part(log, "crashed: signal 11");
  EXPECT_TRUE(std::regex_search(
      log, std::regex("#0 .*CrashPlanner::plan.* at .*crash_planner\\.cpp:" + std::to_string(crashing_line()) + "\n")))
      << log;
  expect_part(crashed.err(),
              "uav_agent-changi failed: signal 11 (Segmentation fault), backtrace in uav_agent-changi.log");
  EXPECT_TRUE(std::regex_search(crashed.err(), std::regex("    #0 .*crash_planner\\.cpp:")))
      << "the launcher's message does not quote the backtrace";
  const Json lost = crashed.result()["lost_members"];
  ASSERT_EQ(lost.size(), 1u) << lost;
  expect_part(lost[0]["reason"], "backtrace in uav_agent-changi.log");
}

TEST_F(Crash, AnAgentThatIsBuiltForDebuggersHasTheOptionOg) {
  SKEIN_NEEDS_GDB();
  ChildProcess& gdb = start_program("gdb", {command_file("gdb"), "-nx", "-batch", "-ex", "list CrashPlanner::plan",
                                            "-ex", "info source", helper_program("crash_agent")});
  gdb.wait();
  std::smatch producer;
  const std::string said = gdb.out();
  ASSERT_TRUE(std::regex_search(said, producer, std::regex("Producer is .*( -O[^ ]*)"))) << said << gdb.err();
  EXPECT_EQ(producer[1], " -Og") << "the compiler uses the last option -O of several";
}

TEST_F(Crash, TheCoreFileIsKeptOnRequest) {
  SKEIN_NEEDS_GDB();
  if (text_of("/proc/sys/kernel/core_pattern").starts_with('|'))
    GTEST_SKIP() << "the kernel passes core files to another program here";
  SkeinRun& crashed = run("crash", flight({"--cores"}), {}, 3);
  const auto core = crashed.dir() / "uav_agent-changi.core";
  expect_part(crashed.err(), "backtrace in uav_agent-changi.log, core in uav_agent-changi.core");
  ASSERT_TRUE(std::filesystem::exists(core));
  ChildProcess& gdb =
      start_program("gdb", {command_file("gdb"), "-nx", "-batch", "-ex", "bt", helper_program("crash_agent"), core});
  gdb.wait();
  expect_part(gdb.out(), "crash_planner.cpp:" + std::to_string(crashing_line()));
}

TEST_F(Crash, BreakOnStopsInTheExchangeOfTheEvent) {
  SKEIN_NEEDS_GDB();
  std::mt19937 random(17);
  for (const auto& [what, reckless] : {std::pair("rejected", true), std::pair("lost", false)}) {
    const int step = 30 + static_cast<int>(random() % 50);
    const std::string planner = fmt::format("changi=crash:at_s={:.2f},reckless={}", 0.05 * step, reckless);
    Arguments words = flight({"--planner", "hover," + planner, "--debug", "changi=gdb", "--break-on", what});
    words.insert(words.begin(), {"skein", "run"});
    words.insert(words.end(), {"--out", dir(what)});
    ChildProcess& skein =
        typed(what, words, "run\nbreak skein::agent::CrashPlanner::plan\ncontinue\nprint in.tick\nkill\n");
    skein.wait();
    expect_part(skein.out() + skein.err(), fmt::format("$1 = {}\n", 20 * step));  // ticks of 2.5 ms
  }
}

TEST_F(Crash, LinesOfAgentsHaveLevelAndSimulatedTime) {
  SkeinRun& crashed = run("crash", flight({"--log", "changi=debug"}), {}, 3);
  const std::string log = text_of(crashed.dir() / "uav_agent-changi.log");
  EXPECT_TRUE(std::regex_search(log, std::regex("\\[uav_agent 1\\.50\\] debug step 30\n"))) << log;
  EXPECT_EQ(text_of(crashed.dir() / "uav_agent-jurong.log").find("debug"), std::string::npos);
}

TEST_F(Crash, AWrongLevelStartsNothing) {
  for (const std::string value : {"changi=loud", "chang=debug", "changi"}) {
    ChildProcess& skein = fly("wrong", {"--log", value});
    EXPECT_EQ(skein.wait().code, 2) << value;
    EXPECT_NE(skein.err().find("--log"), std::string::npos) << skein.err();
    EXPECT_FALSE(std::filesystem::exists(dir("wrong"))) << value;
  }
}

TEST_F(Crash, TwoLevelsForOneProgramStartNothing) {
  ChildProcess& skein = fly("twice", {"--log", "changi=debug", "--log", "changi=warn"});
  EXPECT_EQ(skein.wait().code, 2);
  EXPECT_NE(skein.err().find("--log changi=warn: changi is named twice"), std::string::npos) << skein.err();
  EXPECT_FALSE(std::filesystem::exists(dir("twice")));
}

}  // namespace
}  // namespace skein::test
