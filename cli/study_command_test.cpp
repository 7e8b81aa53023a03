#include "cli/study_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "cli/study/flights.hpp"
#include "cli/sweep/slurm.hpp"
#include "cli/testing/study_commands.hpp"
#include "process/program.hpp"
#include "results/result_file.hpp"

namespace skein::cli {
namespace {

TEST_F(StudyCommand, FliesAllFlightsAndWritesTheReports) {
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(flown(), "hover 1\npatrol 1\nhover 2\npatrol 2\nhover 3\npatrol 3\n");
  EXPECT_NE(file("totals.csv").find("\n1,patrol,max,1010,1020,1030,1030,1020,1010\n"), std::string::npos)
      << file("totals.csv");
  EXPECT_NE(file("report.html").find("Ranking"), std::string::npos);
  EXPECT_NE(file("flights.csv").find(",hover,2,completed,20,"), std::string::npos);
  EXPECT_NE(file("flights.csv").find(",flights/small/hover/seed-2\n"), std::string::npos) << file("flights.csv");
  const std::string head = "figure,scenario,first,second,pairs,median,low,high,p,p_holm\n";
  EXPECT_EQ(file("pairs.csv").find(head + "score," + programs_.scenario().string() + ",hover,patrol,3,-1000,,,,\n"), 0U)
      << file("pairs.csv");
  EXPECT_TRUE(std::filesystem::exists(*options_.out / "flights/small/patrol/seed-3/result.json"));
  EXPECT_NE(err_.str().find("6 of 6: "), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find(" left"), std::string::npos);
  EXPECT_LT(out_.str().find("patrol"), out_.str().find("hover")) << out_.str();
}

TEST_F(StudyCommand, AStudyFliesOnlyTheFlightsThatAreMissing) {
  ASSERT_EQ(run(), kExitDone);
  const std::string report = file("report.html"), flights = file("flights.csv");
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "");
  EXPECT_EQ(file("report.html"), report);
  const auto lost = *options_.out / "flights/small/hover/seed-2";
  std::filesystem::remove(lost / "result.json");
  write_text(*options_.out / "flights/small/patrol/seed-1/result.json", "{\"status\": \"interrupted\", \"seed\": 1}");
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "patrol 1\nhover 2\n");
  EXPECT_EQ(file("flights.csv"), flights);
  options_.rank = Rank::worst;
  EXPECT_EQ(run(), kExitDone) << "another ranking needs no flight";
  EXPECT_EQ(flown(), "");
}

TEST_F(StudyCommand, AResultWithAWrongChecksumIsNamedAndFlownAgain) {
  ASSERT_EQ(run(), kExitDone);
  const std::string flights = file("flights.csv");
  const auto result = *options_.out / "flights/small/hover/seed-2/result.json";
  std::string text = results::result_text(read_json(result));
  write_text(result, text);
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "") << "the checksum of the new result is right";
  text.replace(text.find("\"score\": 20"), 11, "\"score\": 99");
  write_text(result, text);
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "hover 2\n");
  EXPECT_NE(err_.str().find(result.string() + ": is damaged"), std::string::npos) << err_.str();
  EXPECT_EQ(file("flights.csv"), flights);
}

/// An agent program with planners of these names.
std::string agent_script(const std::string& planners, const std::string& build) {
  return "[ \"$1\" != --list-planners ] || echo '{\"planners\": [" + planners + "], \"ground_programs\": []}'\n# " +
         build + "\n";
}

TEST_F(StudyCommand, OnlyThePlannersOfARebuiltAgentProgramFlyAgain) {
  const auto mine = programs_.dir() / "mine";
  write_script(programs_.dir() / "uav_agent", agent_script("\"hover\", \"patrol\"", "stock"));
  write_script(mine, agent_script("\"hover\", \"orbit\", \"patrol\"", "first"));
  options_.agent = mine;
  options_.planner_lists = {"hover,orbit"};
  options_.planners = {"alpha=orbit,beta=hover"};
  options_.seeds = "0";
  ASSERT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(flown(), "hover 0\norbit 0\nalpha=orbit,beta=hover 0\n");
  EXPECT_EQ(agents(), "uav_agent\nmine\nmine\n");

  write_script(mine, agent_script("\"hover\", \"orbit\", \"patrol\"", "second"));
  EXPECT_NE(refusal().find("the agent program was built anew that flies orbit, alpha=orbit,beta=hover"),
            std::string::npos)
      << refusal();
  options_.force = true;
  ASSERT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "orbit 0\nalpha=orbit,beta=hover 0\n");

  options_.force = false;
  EXPECT_EQ(run(), kExitDone) << "nothing has changed";
  EXPECT_EQ(flown(), "");
  write_script(programs_.dir() / "uav_agent", agent_script("\"hover\", \"patrol\"", "anew"));
  options_.force = true;
  ASSERT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "hover 0\n");
}

TEST_F(StudyCommand, TwoAgentProgramsMayFlyPlannersOfTheSameName) {
  for (const char* team : {"a", "b"}) {
    std::filesystem::create_directory(programs_.dir() / team);
    write_script(programs_.dir() / team / "agent", agent_script("\"orbit\"", team));
  }
  const std::string dir = programs_.dir(), a = "orbit@" + dir + "/a/agent", b = "orbit@" + dir + "/b/agent";
  options_.planner_lists = {"patrol," + a + "," + b};
  options_.planners = {"alpha=" + a + ",beta=" + b};
  options_.seeds = "0";
  ASSERT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(flown(), "patrol 0\n" + a + " 0\n" + b + " 0\nalpha=" + a + ",beta=" + b + " 0\n");
  for (const char* label : {",orbit@a/agent,", ",orbit@b/agent,", ",\"alpha=orbit@a/agent,beta=orbit@b/agent\","}) {
    EXPECT_NE(file("flights.csv").find(label), std::string::npos) << label << " in " << file("flights.csv");
  }
  EXPECT_NE(file("report.html").find("<span>orbit@a/agent</span>"), std::string::npos);
  EXPECT_NE(file("report.html").find("patrol," + a + "," + b), std::string::npos) << "the command can be repeated";
  EXPECT_TRUE(std::filesystem::exists(*options_.out / "flights/small/orbit@a_agent/seed-0/result.json"));

  write_script(programs_.dir() / "b/agent", agent_script("\"orbit\"", "anew"));
  options_.force = true;
  ASSERT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(flown(), b + " 0\nalpha=" + a + ",beta=" + b + " 0\n") << "the rebuilt agent program flies these";

  options_.planner_lists.push_back("orbit@" + dir + "/b/../a/agent");
  EXPECT_NE(refusal().find("'" + a + "' is named twice"), std::string::npos) << refusal();
}

TEST_F(StudyCommand, TheRepeatCommandCallsThisSkeinAndNamesItsAgentProgram) {
  const std::string agent = programs_.dir() / "mine";
  write_script(agent, agent_script("\"hover\", \"patrol\"", "mine"));
  ::setenv("SKEIN_AGENT", agent.c_str(), 1);
  const int installed = run();
  const std::string page = file("report.html");
  // The same programs, at the place where a build of the source tree has them, and the tree's script.
  const std::filesystem::path tree = programs_.dir() / "tree", bin = tree / "build/release/bin";
  std::filesystem::create_directories(bin);
  for (const char* name : {"skein", "sim_server", "comm_router", "station", "uav_agent"}) {
    std::filesystem::copy_file(programs_.dir() / name, bin / name);
  }
  write_text(tree / "skein", "");
  ::setenv("SKEIN_BIN_DIR", bin.c_str(), 1);
  options_.force = true;
  const int built = run();
  ::unsetenv("SKEIN_AGENT");
  ASSERT_EQ(installed, kExitDone) << err_.str();
  ASSERT_EQ(built, kExitDone) << err_.str();
  const std::string command = "skein contest --planners hover,patrol", with_agent = " --agent " + agent;
  EXPECT_NE(page.find(command), std::string::npos);
  EXPECT_EQ(page.find("./" + command), std::string::npos);
  EXPECT_NE(page.find(with_agent), std::string::npos);
  EXPECT_NE(file("report.html").find("./" + command), std::string::npos);
  EXPECT_NE(file("report.html").find(with_agent), std::string::npos);
}

TEST_F(StudyCommand, TheNamedAgentProgramFliesAPlannerThatIsAlsoBuiltIn) {
  const auto mine = programs_.dir() / "mine";
  write_script(programs_.dir() / "uav_agent", agent_script("\"hover\", \"patrol\"", "stock"));
  write_script(mine, agent_script("\"hover\"", "mine"));
  const auto other = programs_.dir() / "other";
  write_script(other, agent_script("\"orbit\"", "other"));
  const std::string named = "hover@" + mine.string();
  options_.agent = mine;
  options_.planner_lists = {"hover," + named};
  options_.planners = {"hover,beta=orbit@" + other.string()};
  options_.seeds = "0";
  ASSERT_EQ(run(), kExitDone) << err_.str();
  write_script(mine, agent_script("\"hover\"", "anew"));
  options_.force = true;
  ASSERT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(flown(), named + " 0\n") << "only this planner flies in the program that was changed";
}

TEST_F(StudyCommand, AChangedParameterFileIsRefused) {
  const auto parameters = programs_.dir() / "mine.yaml";
  write_text(parameters, "a: 1\n");
  options_.planner_lists = {"hover:" + parameters.string()};
  ASSERT_EQ(run(), kExitDone);
  write_text(parameters, "a: 2\n");
  EXPECT_NE(refusal().find("parameters are not the same"), std::string::npos) << refusal();
}

TEST_F(StudyCommand, AFlightThatFailsIsNotedAndTheOthersGoOn) {
  hook(
      "if [ $seed = 2 ] && [ $planner = hover ]; then code=3; echo 'uav_agent-alpha failed: exit code 9' >&2; fi\n"
      "if [ $seed = 3 ] && [ $planner = patrol ]; then printf 'pas de r\\351sultat' >&2; exit 3; fi\n");  // no UTF-8
  EXPECT_EQ(run(), kExitProcessFailed);
  EXPECT_EQ(std::ranges::count(flown(), '\n'), 6);
  EXPECT_NE(file("report.html").find("uav_agent-alpha failed: exit code 9"), std::string::npos);
  EXPECT_NE(file("flights.csv").find(",hover,2,completed,20,"), std::string::npos)
      << "an agent failed, but the flight went to its end";
  EXPECT_NE(file("flights.csv").find(",patrol,3,,"), std::string::npos) << file("flights.csv");
  EXPECT_NE(file("totals.csv").find("\n1,patrol,max,1010,1020,,1020,1015,1010\n"), std::string::npos)
      << file("totals.csv");
  hook("");
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "hover 2\npatrol 3\n");
}

TEST_F(StudyCommand, CtrlCStopsAStudyAndTheSameCommandContinuesIt) {
  hook("if [ $seed = 2 ]; then kill -INT $PPID; trap 'exit 130' INT; for i in $(seq 1000); do sleep 0.01; done; fi\n");
  EXPECT_EQ(run(), kExitInterrupted);
  EXPECT_EQ(flown(), "hover 1\npatrol 1\nhover 2\n");
  EXPECT_NE(err_.str().find("continues from here"), std::string::npos) << err_.str();
  EXPECT_NE(file("report.html").find("<strong>2 of 6</strong>"), std::string::npos);
  hook("");
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "hover 2\npatrol 2\nhover 3\npatrol 3\n");
}

TEST_F(StudyCommand, SeveralFlightsAtOnceGiveTheSameResults) {
  ASSERT_EQ(run(), kExitDone);
  const std::string flights = file("flights.csv"), totals = file("totals.csv");
  options_.out = programs_.dir() / "at_once";
  options_.jobs = 4;
  ASSERT_EQ(run(), kExitDone);
  EXPECT_EQ(file("flights.csv"), flights);
  EXPECT_EQ(file("totals.csv"), totals);
}

TEST_F(StudyCommand, AComparisonHasNoTotals) {
  options_.contest = false;
  options_.seeds = "0-1";
  options_.duration_s = 60.0;
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "hover 0\npatrol 0\nhover 1\npatrol 1\n");
  EXPECT_FALSE(std::filesystem::exists(*options_.out / "totals.csv"));
  EXPECT_NE(file("report.html").find("skein compare --planners hover,patrol"), std::string::npos);
  EXPECT_NE(file("report.html").find("missions of 60 s"), std::string::npos);
}

TEST_F(StudyCommand, EachFleetSizeIsASceneOfItsOwn) {
  options_.contest = false;
  options_.seeds = "1";
  options_.uavs = {1, 2};
  EXPECT_EQ(run(), kExitDone) << err_.str();
  EXPECT_EQ(flown(), "hover 1\npatrol 1\nhover 1\npatrol 1\n");
  EXPECT_EQ(read_text(programs_.dir() / "uavs.txt"), "1\n1\n2\n2\n");
  EXPECT_NE(out_.str().find("small.yaml 1 UAV "), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("small.yaml 2 UAVs "), std::string::npos) << out_.str();
  EXPECT_TRUE(std::filesystem::exists(*options_.out / "flights/small-uavs-2/patrol/seed-1/result.json"));
  EXPECT_NE(file("report.html").find(" --uavs 1,2"), std::string::npos);
  options_.uavs = {1};
  EXPECT_NE(refusal().find("uavs: then 1, 2, now 1"), std::string::npos) << refusal();
}

TEST_F(StudyCommand, MistakesAreReportedBeforeAnythingFlies) {
  const StudyOptions good = options_;
  const auto refused = [&](const std::string& with) {
    const std::string message = refusal();
    EXPECT_NE(message.find(with), std::string::npos) << message;
    EXPECT_EQ(flown(), "");
    EXPECT_FALSE(std::filesystem::exists(*options_.out));
    options_ = good;
  };
  options_.planner_lists = {};
  refused("--planners A,B");
  options_.planner_lists = {"hover,hover"};
  refused("'hover' is named twice");
  options_.scenarios = {"towrs"};
  refused("did you mean 'towers'?");
  options_.uavs = {2, 2};
  refused("fleet size '2' is named twice");
  options_.seeds = "x";
  refused("'x' is not a seed");
  options_.planners = {"gamma=hover"};
  refused("no UAV is called 'gamma'");
  write_script(programs_.dir() / "uav_agent",
               "case \"$*\" in *patrol*--check*) echo 'no such planner' >&2; exit 2;; esac");
  refused("planner patrol: no such planner");
}

TEST_F(StudyCommand, TheJobThatMergesReportsItsFailure) {
  write_text(*options_.out, "a file");
  ::setenv(kMergeVariable, "1", 1);
  EXPECT_NE(refusal().find("is not a folder"), std::string::npos) << out_.str();
  ::unsetenv(kMergeVariable);
}

}  // namespace
}  // namespace skein::cli
