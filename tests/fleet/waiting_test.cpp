// Messages name the program for which a fleet waits. Every wait ends: when the program answers, after a timeout, when
// the fleet notices that the program has ended, or with Ctrl-C.
#include <signal.h>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class Waiting : public FleetTest {
 protected:
  Waiting() : scenario_(write_small_scene(folder())) {}

  void end_by_interrupt(SkeinRun& run) {
    run.skein().signal(SIGINT);
    EXPECT_EQ(run.exit_code(), 130) << run.err();
    EXPECT_EQ(run.result()["status"], "interrupted");
    EXPECT_EQ(run.err().find("failed"), std::string::npos) << run.err();
    expect_complete_result(run);
  }

  std::string scenario_;
};

TEST_F(Waiting, AProgramThatNeverJoinsIsNamed) {
  SkeinRun& run = start("run", {scenario_, "--planner", "hover,changi=exec:exec sleep 1000"});
  EXPECT_TRUE(run.wait_for("waiting for changi to join (")) << run.err();
  EXPECT_NE(text_of(run.dir() / "sim_server.log").find("waiting for changi"), std::string::npos)
      << "users without a launcher can read only in the server's log for which program the fleet waits";
  end_by_interrupt(run);
}

TEST_F(Waiting, AProgramThatHangsIsNamed) {
  SkeinRun& run = start("run", {scenario_, "--planner", "hover", "--duration", "2000"});
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  ::kill(processes_of(run.dir()).at("uav_agent-changi"), SIGSTOP);
  EXPECT_TRUE(run.wait_for("waiting for changi to answer (")) << run.err();
  end_by_interrupt(run);
}

TEST_F(Waiting, AServerThatHangsIsNamed) {
  SkeinRun& run = start("run", {scenario_, "--planner", "hover", "--duration", "2000"});
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  const pid_t server = processes_of(run.dir()).at("sim_server");
  ::kill(server, SIGSTOP);
  EXPECT_TRUE(run.wait_for("waiting for sim_server (")) << run.err();
  ::kill(server, SIGCONT);
  end_by_interrupt(run);
}

TEST_F(Waiting, TwoHungPlannersDelayTheRunByOneTimeout) {
  SkeinRun& run = start("run", {scenario_, "--planner", "exec:" + helper_program("minimal_client") + " hang",
                                "--duration", "20", "--agent-timeout", "1"});
  EXPECT_EQ(run.exit_code(), 3) << run.err();
  const Json lost = run.result()["lost_members"];
  ASSERT_EQ(lost.size(), 2u) << lost;
  EXPECT_EQ(lost[0]["step"], lost[1]["step"]);
  EXPECT_TRUE(lost[0]["reason"].get<std::string>().starts_with("did not answer for 1 s (waited for: done of step"))
      << lost[0]["reason"];
}

/// A fleet with `--debug changi`: the test starts the agent of changi under a tool, as a user starts it under gdb. The
/// tool may run longer than the agent.
class Debugged : public Waiting {
 protected:
  void start_fleet(const std::string& planner = "hover") {
    run_ = &start("run", {scenario_, "--planner", planner, "--duration", "2000", "--debug", "changi"});
    ASSERT_TRUE(run_->wait_for("changi yourself")) << run_->err();
  }
  void start_fleet_that_ends() {
    run_ = &start("run", {scenario_, "--planner", "hover", "--duration", "5", "--debug", "changi"});
    ASSERT_TRUE(run_->wait_for("changi yourself")) << run_->err();
  }
  /// @param tool  replaces "gdb --args", or precedes a user's command.
  ChildProcess& start_tool(const std::string& tool) {
    return start_program("tool", {"/bin/sh", "-c", run_->debug_command(tool)});
  }
  pid_t debugged() const {
    const auto found = processes_of(run_->dir());
    return found.contains("uav_agent-changi") ? found.at("uav_agent-changi") : 0;
  }
  void expect_fleet_goes_on() {
    EXPECT_TRUE(run_->wait_for("the debugged program of changi (process ")) << run_->err();
    EXPECT_TRUE(eventually(
        [&] { return text_of(run_->dir() / "sim_server.log").find("changi is lost") != std::string::npos; }));
    end_by_interrupt(*run_);
    const Json result = run_->result();
    ASSERT_EQ(result["lost_members"].size(), 1u) << result["lost_members"];
    EXPECT_EQ(result["lost_members"][0]["member"], "changi");
    EXPECT_EQ(result["warnings"].dump().find("waited for"), std::string::npos)
        << "the server ended while it still waited for an answer";
  }

  SkeinRun* run_ = nullptr;
};

TEST_F(Debugged, AnAgentThatDiesIsLostAlthoughItsToolStillRuns) {
  start_fleet();
  const std::string tool = write("tool.sh", "\"$@\" & wait\nexec sleep 1000\n");
  ChildProcess& process = start_tool("/bin/sh " + tool);
  ASSERT_TRUE(run_->wait_until_flying()) << run_->err();
  ::kill(debugged(), SIGKILL);
  expect_fleet_goes_on();
  EXPECT_FALSE(process.ended()) << "the tool belongs to the user, so it must not be ended";
}

TEST_F(Debugged, AnExecCommandThatDiesIsLost) {
  start_fleet("hover,changi=exec:exec " + helper_program("minimal_client"));
  start_tool("");
  ASSERT_TRUE(run_->wait_until_flying()) << run_->err();
  ::kill(debugged(), SIGKILL);
  expect_fleet_goes_on();
}

TEST_F(Debugged, TheFleetFliesOnWhenTheUserLeavesGdb) {
  if (!std::filesystem::exists("/usr/bin/gdb")) GTEST_SKIP() << "no gdb here";
  start_fleet();
  ChildProcess& gdb = start_tool("gdb -nx -batch -ex run --args");
  eventually([&] { return is_flying(run_->dir()) || gdb.ended() || run_->skein().ended(); });
  if (gdb.ended()) GTEST_SKIP() << "gdb may not debug here: " << gdb.err();
  ASSERT_TRUE(is_flying(run_->dir())) << run_->err();
  gdb.signal(SIGKILL);
  expect_fleet_goes_on();
}

TEST_F(Debugged, AnAgentThatEndsWithTheRunIsNotLost) {
  start_fleet_that_ends();
  start_tool("");
  EXPECT_EQ(run_->exit_code(), 0) << run_->err();
  EXPECT_EQ(run_->err().find("debugged program"), std::string::npos) << run_->err();
}

// gdb stops the agent for 2 s before it writes its report; by then all other programs of the fleet have ended.
TEST_F(Debugged, TheLauncherWaitsForTheReportOfAnAgentThatEndsLate) {
  if (!std::filesystem::exists("/usr/bin/gdb")) GTEST_SKIP() << "no gdb here";
  start_fleet_that_ends();
  ChildProcess& gdb =
      start_tool("gdb -nx -batch -ex 'break skein::hand_in_report' -ex run -ex 'shell sleep 2' -ex continue --args");
  EXPECT_EQ(run_->exit_code(), 0) << run_->err();
  if (gdb.wait().code != 0) GTEST_SKIP() << "gdb may not debug here: " << gdb.err();
  EXPECT_NE(gdb.out().find("exited normally"), std::string::npos) << gdb.out();
  EXPECT_EQ(run_->result()["warnings"], Json::array());
}

}  // namespace
}  // namespace skein::test
