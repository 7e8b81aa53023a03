
#include <gtest/gtest.h>

#include <csignal>
#include <regex>
#include <sstream>

#include "cli/report_command.hpp"
#include "cli/run_command.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "results/result.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

/// A server that waits for one control line, then ends the run and reports.
constexpr const char* kServer = R"(
echo '{"type":"progress","t":1.5,"mission_s":1.0,"phase":"flying","duration_s":600,"in_contact":[],"alive":2,"lost":[]}' >&3
[ -z "$wait_for_control" ] || { read line <&4; echo "$line" > "$out/control.txt"; }
echo '{"status":"completed","deterministic":true,"digest":"ab","sim_time_s":9.5,"mission_time_s":9,"wall_time_s":1,
       "points_total":5,"collisions":[],"uavs":[],"lost_members":[],"warnings":[]}' > "$out/sim_server.report.json"
echo '{"points":[[1,2,3,0,0,1]]}' > "$out/scene.json"
echo '{"type":"ended","status":"completed"}' >&3
)";

/// A member that ends once the server has written its report, as a real member does at the end of a run.
constexpr const char* kMember = R"(
until [ -e "$out/scene.json" ]; do sleep 0.01; done
)";

class RunCommand : public ::testing::Test {
 protected:
  RunCommand() {
    programs_.script("sim_server", kServer);
    for (const char* name : {"comm_router", "station", "uav_agent"}) programs_.script(name, kMember);
    options_.scenario = programs_.scenario();
    options_.planner = "hover,beta=patrol";
    options_.out = programs_.dir() / "out";
  }

  int run() { return run_fleet(options_, {out_, err_, false}); }
  Json result() const { return read_json(*options_.out / "result.json"); }
  std::string control_line() const { return read_text(*options_.out / "control.txt"); }
  void let_the_server_wait() { programs_.script("sim_server", std::string("wait_for_control=1\n") + kServer); }

  FakePrograms programs_;
  RunOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(RunCommand, TheAgentProgramOfTheUserFliesInThePlaceOfUavAgent) {
  programs_.script("uav_agent", "exit 9\n");
  write_script(
      programs_.dir() / "mine",
      "[ \"$1\" != --list-planners ] || { echo '{\"planners\":[\"hover\"],\"ground_programs\":[]}'; exit; }\n" +
          std::string(kReadOptions) + "echo \"config $SKEIN_CONFIG_DIR\"\n" + kMember);
  options_.agent = programs_.dir() / "mine";
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["agent"], (programs_.dir() / "mine").string());
  EXPECT_NE(read_text(*options_.out / "uav_agent-beta.log").find("config " + source_path("config")), std::string::npos);
}

TEST_F(RunCommand, TheRepeatCommandNamesTheAgentProgramOfTheEnvironment) {
  const std::string mine = programs_.dir() / "mine";
  write_script(
      mine, "[ \"$1\" != --list-planners ] || { echo '{\"planners\":[\"hover\"],\"ground_programs\":[]}'; exit; }\n" +
                std::string(kReadOptions) + kMember);
  options_.command = "skein run small.yaml";
  ::setenv("SKEIN_AGENT", mine.c_str(), 1);
  const int code = run();
  ::unsetenv("SKEIN_AGENT");
  ASSERT_EQ(code, kExitDone) << err_.str();
  EXPECT_EQ(result()["command"], "skein run small.yaml --agent " + mine);
  EXPECT_NE(read_text(*options_.out / "report.html").find("skein run small.yaml --agent " + mine), std::string::npos);

  // A user who typed the option gets the command as typed.
  options_.command = "skein run small.yaml --agent mine";
  options_.agent = mine;
  options_.force = true;
  ASSERT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["command"], options_.command);
}

TEST_F(RunCommand, AProgramThatIsNotAnAgentIsRefusedBeforeTheStart) {
  write_text(programs_.dir() / "text", "no program");
  write_script(programs_.dir() / "other", "exit 0\n");
  for (const char* name : {"missing", "text", "other"}) {
    options_.agent = programs_.dir() / name;
    EXPECT_THROW(run(), InputError) << name;
  }
  write_script(programs_.dir() / "broken", "echo two of a kind\nexit 3\n");
  options_.agent = programs_.dir() / "broken";
  try {
    run();
    ADD_FAILURE() << "the run was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("two of a kind"), std::string::npos) << error.what();
  }
  options_.agent.reset();
  ::setenv("SKEIN_AGENT", (programs_.dir() / "missing").c_str(), 1);
  EXPECT_THROW(run(), InputError);
  ::unsetenv("SKEIN_AGENT");
}

TEST_F(RunCommand, AGoodRunLeavesAResultAndATable) {
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["status"], "completed");
  EXPECT_EQ(result()["planner"], (Json{{"alpha", "hover"}, {"beta", "patrol"}}));
  EXPECT_EQ(result()["sim_time_s"], 9.5);
  EXPECT_TRUE(std::filesystem::exists(*options_.out / "score.csv"));
  for (const char* name : {"sim_server", "comm_router", "station", "uav_agent-alpha", "uav_agent-beta"}) {
    EXPECT_TRUE(std::filesystem::exists(*options_.out / (std::string(name) + ".log"))) << name;
  }
  EXPECT_NE(out_.str().find("alpha"), std::string::npos);
  EXPECT_NE(out_.str().find("digest    ab"), std::string::npos);
}

TEST_F(RunCommand, TheLauncherAsksTheOracleOnceTheRunIsOver) {
  const std::string oracle = R"(
case "$*" in *--oracle*)
  while [ "$1" != --oracle ]; do shift; done
  echo '{"rows": [{"clearance_m": 0.5, "reachable": {"points": 1, "score": 0.75}, "outside": {"points": 0, "score": 0},
         "estimate": [0.75], "flyable": "1"}]}' > "$2"
  exit 0 ;;
esac
)";
  std::string server = kServer;
  server.replace(server.find("\"points_total\""), 0, "\"points_seen\": \"0\", ");
  write_script(programs_.dir() / "sim_server", oracle + kReadOptions + server);
  programs_.script("station", std::string(kMember) + R"(echo '{"points": []}' > "$out/station.report.json")");
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["attainable"], Json::parse(R"({"points": 1, "score": 0.75, "clearance_m": 0.5,
                                                    "outside": {"points": 0, "score": 0}})"));
  EXPECT_NE(out_.str().find("of 5, 1 attainable"), std::string::npos) << out_.str();
  // The only point of the scenario was never in a picture.
  EXPECT_EQ(result()["losses"]["never_in_picture"], (Json{{"points", 1}, {"score", 0.75}}));
  EXPECT_NE(out_.str().find("lost      never in the picture         0.750       1 points\n"), std::string::npos)
      << out_.str();
  EXPECT_TRUE(std::filesystem::exists(*options_.out / "losses.csv"));
  options_.force = true;
  options_.attainable = false;
  EXPECT_EQ(run(), kExitDone);
  EXPECT_TRUE(result()["attainable"]["score"].is_null());
  EXPECT_TRUE(result()["losses"].is_null());
  EXPECT_FALSE(std::filesystem::exists(*options_.out / "losses.csv"));
}

TEST_F(RunCommand, ThePageOfARunCanBeMadeAgainOrLeftOut) {
  options_.command = "skein run 'what was typed'";
  ASSERT_EQ(run(), kExitDone);
  const std::filesystem::path page = *options_.out / "report.html";
  const std::string text = read_text(page);
  EXPECT_EQ(result()["command"], options_.command);
  EXPECT_NE(text.find("skein run &#39;what was typed&#39;"), std::string::npos);
  std::filesystem::remove(page);
  EXPECT_EQ(make_reports({{"nowhere", *options_.out}}, {out_, err_, false}), kExitBadInput);
  EXPECT_EQ(read_text(page), text) << "the folder that has a result gets its page";
  EXPECT_EQ(make_reports({{*options_.out}}, {out_, err_, false}), kExitDone) << err_.str();
  options_.force = true;
  options_.report = false;
  ASSERT_EQ(run(), kExitDone);
  EXPECT_FALSE(std::filesystem::exists(page)) << "the page of an earlier run must not stay in the folder";
}

TEST_F(RunCommand, APageThatCannotBeWrittenIsAWarning) {
  programs_.script("sim_server", "mkdir $out/report.html\n" + std::string(kServer));
  EXPECT_EQ(run(), kExitDone);
  EXPECT_NE(result()["warnings"].dump().find("no report.html"), std::string::npos) << result()["warnings"];
  EXPECT_NE(out_.str().find("warning: no report.html"), std::string::npos) << out_.str();
}

TEST_F(RunCommand, AnExistingResultIsKept) {
  ASSERT_EQ(run(), kExitDone);
  EXPECT_THROW(run(), InputError);
  options_.force = true;
  EXPECT_EQ(run(), kExitDone);
}

TEST_F(RunCommand, BadInputStartsNothing) {
  write_script(programs_.dir() / "uav_agent",
               "case \"$*\" in *patrol*--check*) echo 'no such planner' >&2; exit 2;; esac");
  try {
    run();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no such planner");
  }
  EXPECT_FALSE(std::filesystem::exists(*options_.out));
}

TEST_F(RunCommand, AnUnknownDebugUavIsBadInput) {
  options_.debug = {"gamma"};
  EXPECT_THROW(run(), InputError);
}

TEST_F(RunCommand, ADeadAgentIsNamedAndTheLauncherTellsTheServer) {
  let_the_server_wait();
  programs_.script("uav_agent", std::string("[ $uav = alpha ] || { echo last words >&2; exit 9; }\n") + kMember);
  EXPECT_EQ(run(), kExitProcessFailed);
  EXPECT_EQ(control_line(), "lost beta\n");
  EXPECT_NE(err_.str().find("uav_agent-beta failed: exit code 9"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("last words"), std::string::npos);
  EXPECT_EQ(result()["status"], "completed");
}

TEST_F(RunCommand, ADeadRouterOrStationIsReported) {
  for (const char* program : {"comm_router", "station"}) {
    options_.force = true;
    let_the_server_wait();
    for (const char* name : {"comm_router", "station"}) programs_.script(name, kMember);
    programs_.script(program, "kill -KILL $$");
    EXPECT_EQ(run(), kExitProcessFailed);
    EXPECT_EQ(control_line(), std::string("lost ") + program + "\n");
  }
}

TEST_F(RunCommand, ADeadServerEndsTheRunAsAborted) {
  programs_.script("sim_server", R"(echo '{"type":"progress","t":12.5,"mission_s":10}' >&3; kill -SEGV $$)");
  programs_.script("uav_agent", "trap 'exit 0' TERM; while :; do read line <&4; done");
  EXPECT_EQ(run(), kExitProcessFailed);
  EXPECT_EQ(result()["status"], "aborted");
  EXPECT_EQ(result()["sim_time_s"], 12.5);
  EXPECT_TRUE(result()["digest"].is_null());
  EXPECT_NE(err_.str().find("sim_server failed: signal 11"), std::string::npos);
  EXPECT_EQ(err_.str().find("uav_agent-alpha failed"), std::string::npos) << "the launcher ended it itself";
}

TEST_F(RunCommand, CtrlCStopsTheServerAndKeepsTheResult) {
  programs_.script("sim_server", std::string("kill -INT $PPID\nwait_for_control=1\n") + kServer);
  EXPECT_EQ(run(), kExitInterrupted);
  EXPECT_EQ(control_line(), "stop\n");
  EXPECT_EQ(result()["sim_time_s"], 9.5);
}

TEST_F(RunCommand, ASecondCtrlCEndsTheRunAtOnce) {
  programs_.script("sim_server", "kill -INT $PPID; read line <&4; kill -INT $PPID; read line <&4");
  programs_.script("uav_agent", "read line <&4");
  EXPECT_EQ(run(), kExitInterrupted);
  EXPECT_EQ(result()["status"], "interrupted");
}

/// The report of a server that was stopped.
constexpr const char* kInterruptedReport = R"(
echo '{"status":"interrupted","deterministic":false,"sim_time_s":0,"uavs":[],"lost_members":[],"warnings":[]}' \
    > "$out/sim_server.report.json"
echo '{"type":"ended","status":"interrupted"}' >&3
)";

TEST_F(RunCommand, CtrlCBeforeTheFirstStepBlamesNoProgram) {
  // These programs do not know that the run is over, and fail when the launcher ends them.
  for (const char* name : {"comm_router", "station", "uav_agent"}) {
    programs_.script(name, "trap 'exit 3' TERM; echo 1 >> \"$out/started\"; while :; do sleep 0.01; done");
  }
  programs_.script("sim_server",
                   "until [ \"$(cat \"$out/started\" 2> /dev/null | wc -l)\" = 4 ]; do sleep 0.01; done\n"
                   "kill -INT $PPID; read line <&4\n" +
                       std::string(kInterruptedReport));
  EXPECT_EQ(run(), kExitInterrupted);
  EXPECT_EQ(result()["status"], "interrupted");
  EXPECT_EQ(err_.str().find("failed"), std::string::npos) << err_.str();
  EXPECT_EQ(result()["warnings"].dump().find("failed"), std::string::npos) << result()["warnings"];
}

TEST_F(RunCommand, AfterCtrlCTheWaitIsShortAndNoProgramIsBlamed) {
  options_.patience = 0.02;
  // The planner of beta hangs, so the server, which waits for it, never ends its step.
  programs_.script("sim_server", "kill -INT $PPID; trap '' TERM; while :; do sleep 0.01; done");
  programs_.script("uav_agent", "[ $uav = alpha ] || trap '' TERM; while :; do sleep 0.01; done");
  EXPECT_EQ(run(), kExitInterrupted);
  EXPECT_EQ(result()["status"], "interrupted");
  EXPECT_EQ(err_.str().find("failed"), std::string::npos) << err_.str();
}

TEST_F(RunCommand, ACrashAfterCtrlCIsReportedAllTheSame) {
  // Before the first step, the launcher would end the server at once, perhaps before its crash.
  programs_.script("sim_server", R"(echo '{"type":"progress","t":12.5,"mission_s":10}' >&3; sleep 0.2)"
                                 "\nkill -INT $PPID; read line <&4\n" +
                                     std::string(kInterruptedReport) + "kill -SEGV $$");
  EXPECT_EQ(run(), kExitInterrupted);
  EXPECT_NE(err_.str().find("sim_server failed: signal 11"), std::string::npos) << err_.str();
}

TEST_F(RunCommand, AMemberThatTheServerLostMakesTheRunAFailure) {
  programs_.script("sim_server", std::string(kServer) + R"(
    echo '{"status":"completed","lost_members":[{"member":"alpha","step":1,"time_s":0.05,"reason":"hangs"}]}' \
        > "$out/sim_server.report.json")");
  EXPECT_EQ(run(), kExitProcessFailed);
  EXPECT_EQ(result()["lost_members"][0]["member"], "alpha");
}

TEST_F(RunCommand, ACommandTakesThePlaceOfAnAgent) {
  const std::string command =
      "env > \"$SKEIN_OUT/env.txt\"; echo hello, world; echo '{\"type\":\"tally\",\"score\":9}' >&3; "
      "until [ -e \"$SKEIN_OUT/scene.json\" ]; do sleep 0.01; done";
  options_.planner = "hover,beta=exec:" + command;
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["planner"], (Json{{"alpha", "hover"}, {"beta", "exec:" + command}}));
  EXPECT_EQ(result()["score"], 0.0) << "a score that a command reports does not count";
  EXPECT_EQ(read_text(*options_.out / "uav_agent-beta.log"), "hello, world\n");
  const std::string environment = "\n" + read_text(*options_.out / "env.txt");
  for (const std::string& variable :
       {std::string("SKEIN_UAV=beta"), std::string("SKEIN_DDS=cyclonedds"), std::string("OMP_NUM_THREADS=1"),
        "SKEIN_SCENARIO=" + programs_.scenario().string(), "SKEIN_OUT=" + options_.out->string()}) {
    EXPECT_NE(environment.find("\n" + variable + "\n"), std::string::npos) << variable << environment;
  }
  // The second UAV has the last of the fleet's domains. The launcher has printed the range of domains.
  std::smatch domain;
  ASSERT_TRUE(std::regex_search(environment, domain, std::regex("\nSKEIN_DOMAIN=([0-9]+)\n"))) << environment;
  EXPECT_NE(err_.str().find(".." + domain[1].str() + ","), std::string::npos) << err_.str();
  EXPECT_NE(environment.find("\nROS_DOMAIN_ID=" + domain[1].str() + "\n"), std::string::npos) << "for ROS";
  const Json warnings = result()["warnings"];
  for (const Json& warning : warnings) {
    EXPECT_EQ(warning.get<std::string>().find("uav_agent-beta"), std::string::npos) << warning;
  }
}

TEST_F(RunCommand, ACommandThatDoesNotNoticeTheEndIsEndedWithoutAComplaint) {
  options_.planner = "exec:while :; do sleep 60; done";
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(err_.str().find("failed"), std::string::npos) << err_.str();
}

TEST_F(RunCommand, ACommandThatFailsIsNamedLikeAnAgent) {
  let_the_server_wait();
  options_.planner = "hover,beta=exec:./no_such_program";
  EXPECT_EQ(run(), kExitProcessFailed);
  EXPECT_EQ(control_line(), "lost beta\n");
  EXPECT_NE(err_.str().find("uav_agent-beta failed: exit code 127"), std::string::npos) << err_.str();
}

TEST_F(RunCommand, DebugPrintsACommandWithItsEnvironment) {
  options_.planner = "hover,beta=exec:./mine 'a b'";
  options_.debug = {"beta"};
  EXPECT_EQ(run(), kExitDone);
  EXPECT_NE(err_.str().find(" SKEIN_UAV=beta /bin/sh -c './mine '\\''a b'\\'''"), std::string::npos) << err_.str();
}

TEST_F(RunCommand, DebugLeavesOneAgentToTheUser) {
  options_.debug = {"beta"};
  EXPECT_EQ(run(), kExitDone);
  EXPECT_FALSE(std::filesystem::exists(*options_.out / "uav_agent-beta.log"));
  EXPECT_NE(err_.str().find("gdb --args"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("--uav beta --planner patrol"), std::string::npos) << err_.str();
}

TEST_F(RunCommand, ReportsThatComeThroughThePipeNeedNoFiles) {
  programs_.script("station", std::string(kMember) +
                                  R"(echo '{"type":"report","report":{"score":2.5,"points_detected":3,)" +
                                  R"("unwritten":["cannot write x/captures.csv: No space left on device"]}}' >&3)");
  programs_.script("comm_router", std::string(kMember) + R"(echo '{"type":"report","report":{"sent":11}}' >&3)");
  options_.planner = "hover,beta=exec:echo '{\"type\":\"report\",\"report\":{\"planner_cpu_s\":9}}' >&3";
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["score"], 2.5);
  EXPECT_EQ(result()["points_detected"], 3);
  EXPECT_EQ(result()["radio"]["sent"], 11);
  EXPECT_TRUE(result()["uavs"][1]["planner_cpu_s"].is_null()) << "a command's message about itself is not a report";
  const std::string words = "files are missing or cut short: cannot write x/captures.csv: No space left on device";
  EXPECT_NE(result()["warnings"].dump().find(words), std::string::npos) << result()["warnings"];
  EXPECT_NE(out_.str().find("warning: files are missing"), std::string::npos) << out_.str();
}

TEST_F(RunCommand, AResultThatCannotBeWrittenIsPrinted) {
  programs_.script("station",
                   std::string(kMember) + R"(mkdir "$out/result.json"; touch "$out/result.json/in_the_way")");
  EXPECT_EQ(run(), kExitProcessFailed);
  const std::string said = err_.str();
  EXPECT_NE(said.find("result.json"), std::string::npos) << said;
  const std::size_t begin = said.find("\n{\n");
  ASSERT_NE(begin, std::string::npos) << said;
  EXPECT_EQ(Json::parse(said.substr(begin))["sim_time_s"], 9.5);
}

TEST_F(RunCommand, AWarningThatComesLastIsInTheResultToo) {
  std::string server = kServer;
  server.replace(server.find("echo '{\"points\""), 0, "echo nonsense > \"$out/scene.json\"; : ");
  programs_.script("sim_server", server);
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["warnings"].back(), "no scene.json: no score.csv");
}

TEST_F(RunCommand, AnAgentThatFloodsItsStatusPipeIsNamedAndTheRunGoesOn) {
  options_.planner = "hover,beta=exec:trap '' PIPE; yes | tr -d '\\n' >&3; exit 0";
  EXPECT_EQ(run(), kExitDone) << err_.str();
  const std::string words = "uav_agent-beta: Skein reads no further status from it";
  EXPECT_NE(err_.str().find(words), std::string::npos) << err_.str();
  EXPECT_NE(result()["warnings"].dump().find(words), std::string::npos) << result()["warnings"];
}

TEST_F(RunCommand, APipeInTheNameOfAReportBlocksNoRun) {
  options_.planner =
      "hover,beta=exec:mkfifo \"$SKEIN_OUT/station.report.json\" \"$SKEIN_OUT/uav_agent-beta.report.json\"";
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(result()["status"], "completed");
}

}  // namespace
}  // namespace skein::cli
