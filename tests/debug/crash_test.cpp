// What a program that crashes leaves behind, and what agents log.
#include <regex>

#include "debug_fixture.hpp"

namespace skein::test {
namespace {

class Crash : public DebugTest {
 protected:
  Arguments flight(const Arguments& more = {}) const {
    Arguments words = {scenario_,    "--planner", "hover,changi=crash", "--agent", SKEIN_CRASH_AGENT,
                       "--duration", "5",         "--no-oracle"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::size_t crashing_line() {
    const std::string text = text_of(SKEIN_SOURCE_DIR "/tests/debug/crash_planner.cpp");
    return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + text.find("// HERE"), '\n'));
  }
};

TEST_F(Crash, ItsBacktraceNamesTheLine) {
  SkeinRun& crashed = run("crash", flight(), {}, 3);
  const std::string log = text_of(crashed.dir() / "uav_agent-changi.log");
  expect_part(log, "crashed: signal 11");
  EXPECT_TRUE(std::regex_search(
      log, std::regex("#0 .*CrashPlanner::plan.* at .*crash_planner\\.cpp:" + std::to_string(crashing_line()) + "\n")))
      << log;
  expect_part(crashed.err(),
              "uav_agent-changi failed: signal 11 (Segmentation fault), backtrace in uav_agent-changi.log");
  const Json lost = crashed.result()["lost_members"];
  ASSERT_EQ(lost.size(), 1u) << lost;
  expect_part(lost[0]["reason"], "backtrace in uav_agent-changi.log");
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
    EXPECT_FALSE(std::filesystem::exists(dir("wrong"))) << value;
  }
}

}  // namespace
}  // namespace skein::test
