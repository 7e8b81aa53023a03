// Fleets in one process, as a user starts them. fleet_reference_digests_test checks that they fly as over DDS. This
// file checks that each program in the process has its own log, and that the failure of one is reported as its own.
#include <algorithm>
#include <fstream>

#include "fleet_fixture.hpp"
#include "json_schema.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class OneProcess : public FleetTest {
 protected:
  Arguments flight(Arguments more, const std::string& duration_s = "8") const {
    more.insert(more.begin(), {scene_, "--one-process", "--no-oracle", "--duration", duration_s});
    return more;
  }
  /// Uses the agent of nasty_planner.cpp: jurong misbehaves in this way at 3 s.
  Arguments nasty(const std::string& how, Arguments more = {}) const {
    more.insert(more.end(), {"--agent", helper_program("nasty_agent"), "--planner", "hover,jurong=nasty:how=" + how});
    return flight(more);
  }
  /// Flies a run in which jurong's program ends the whole process. Messages must name only jurong.
  SkeinRun& end_with_jurong(const std::string& how, Arguments more = {}) {
    more.insert(more.end(), {"--agent-timeout", "2"});
    SkeinRun& flown = run(how, nasty(how, more), {}, 3);
    EXPECT_TRUE(says(flown.err(), "uav_agent-jurong failed: ")) << flown.err();
    EXPECT_FALSE(says(flown.err(), "changi failed")) << flown.err();
    EXPECT_FALSE(says(flown.err(), "one_process failed")) << flown.err();
    return flown;
  }

  const std::string scene_ = write_small_scene(folder());  ///< two UAVs: jurong and changi
};

TEST_F(OneProcess, RefusesInvalidNumbersOfThreads) {
  SkeinRun& none = run("none", flight({"--threads", "0"}), {}, 2);
  EXPECT_TRUE(says(none.err(), "--threads")) << none.err();
  SkeinRun& named = run("named", flight({}), {{"SKEIN_THREADS", "many"}}, 2);
  EXPECT_TRUE(says(named.err(), "SKEIN_THREADS: 'many'")) << named.err();
  SkeinRun& over_dds = run("over_dds", {scene_, "--threads", "2"}, {}, 2);
  EXPECT_TRUE(says(over_dds.err(), "--one-process")) << over_dds.err();
}

TEST_F(OneProcess, RefusesOptionsThatNeedProcesses) {
  const std::vector<std::pair<Arguments, std::string>> refused = {
      {{"--planner", "hover,jurong=exec:true"}, "jurong=exec:true needs processes"},
      {{"--planner", "hover,gcs=exec:true"}, "gcs=exec:true needs processes"},
      {{"--planner", "hover,jurong=hover@" + helper_program("nasty_agent")}, "are two programs"},
      {{"--debug", "jurong"}, "--debug needs processes"},
      {{"--secure"}, "--secure needs processes"},
      {{"--network", "all"}, "--network needs processes"},
      {{"--domain", "5"}, "--domain needs processes"},
      {{"--dds", "fastdds"}, "--dds"}};
  int number = 0;
  for (const auto& [arguments, reason] : refused) {
    SkeinRun& run = this->run("refused" + std::to_string(++number), flight(arguments), {}, 2);
    EXPECT_TRUE(says(run.err(), reason)) << run.err();
    EXPECT_TRUE(says(run.err(), "--one-process")) << run.err();
    EXPECT_FALSE(std::filesystem::exists(run.dir()));
  }
}

TEST_F(OneProcess, LeavesTheSameFilesAsProcesses) {
  SkeinRun& one = run("one", flight({"--planner", "patrol"}));
  SkeinRun& many = run("many", {scene_, "--no-oracle", "--duration", "8", "--planner", "patrol"});
  EXPECT_EQ(one.digest(), many.digest());
  expect_complete_result(one);
  std::set<std::string> files, usual;
  for (const auto& entry : std::filesystem::directory_iterator(one.dir())) files.insert(entry.path().filename());
  for (const auto& entry : std::filesystem::directory_iterator(many.dir())) usual.insert(entry.path().filename());
  usual.insert("one_process.log");
  EXPECT_EQ(files, usual);
  for (const char* table :
       {"activity.csv", "captures.csv", "events.csv", "score.csv", "score_timeline.csv", "trajectories.csv"}) {
    EXPECT_EQ(text_of(one.dir() / table), text_of(many.dir() / table)) << table;
  }
  EXPECT_EQ(one.result()["processes"].size(), 1U);
  EXPECT_EQ(one.result()["radio"], many.result()["radio"]);
}

TEST_F(OneProcess, AUavThatGetsAnotherBatteryFliesAgain) {
  std::ofstream(scene_, std::ios::app) << "\nconditions: {battery: {endurance_missions: 0.3, swap_s: 5}}\n";
  SkeinRun& run = this->run("swapped", flight({"--planner", "patrol"}, "120"));
  const Json result = run.result();
  const Json schema = Json::parse(text_of(source_path("docs/result.schema.json")));
  EXPECT_EQ(schema_errors(result, schema), std::vector<std::string>());
  EXPECT_EQ(result["mission_time_s"], 120.0);
  for (const Json& uav : result["uavs"]) {
    SCOPED_TRACE(uav["name"].get<std::string>());
    EXPECT_GE(uav["battery"]["swaps"], 1);
    EXPECT_TRUE(uav["alive"]);
    double charge = 1.0, highest_m = 0.0;
    bool swapped = false;
    for (const auto& row : read_csv(run.dir() / "trajectories.csv")) {
      if (row.at("uav") != uav["name"]) continue;
      swapped = swapped || std::stod(row.at("charge")) > charge;
      charge = std::stod(row.at("charge"));
      if (swapped) highest_m = std::max(highest_m, std::stod(row.at("z")));
    }
    EXPECT_GT(highest_m, 3.0) << "the UAV did not take off with its new battery";
  }
}

TEST_F(OneProcess, AMemberThatThrowsIsLostAndTheOthersFlyOn) {
  for (const std::string how : {"throws", "throws_number"}) {
    SkeinRun& run = this->run(how, nasty(how), {}, 3);
    const Json result = run.result();
    EXPECT_EQ(result["status"], "completed") << "the other UAVs did not fly on";
    ASSERT_EQ(result["lost_members"].size(), 1U) << result["lost_members"];
    EXPECT_EQ(result["lost_members"][0]["member"], "jurong");
    EXPECT_FALSE(result["deterministic"]);
    EXPECT_TRUE(says(run.err(), "uav_agent-jurong failed: ")) << run.err();
    EXPECT_EQ(says(run.err(), "I do not like it here"), how == "throws") << run.err();
    expect_complete_result(run);
  }
}

TEST_F(OneProcess, AProgramThatEndsTheWholeProcessIsNamed) {
  const std::vector<std::pair<std::string, std::string>> deaths = {{"segfaults", "signal 11"},
                                                                   {"aborts", "signal 6"},
                                                                   {"overflows", "signal 11"},
                                                                   {"exits", "called exit(0)"},
                                                                   {"hangs", "did not end its turn for 2 s"}};
  for (const auto& [how, reason] : deaths) {
    SCOPED_TRACE(how);
    SkeinRun& run = end_with_jurong(how, {"--threads", "2"});
    if (sanitizer().empty()) {  // a sanitizer handles such deaths itself, and writes the end of the log
      EXPECT_TRUE(says(run.err(), "nasty " + how)) << "the launcher does not quote the program's last output";
      EXPECT_TRUE(says(run.err(), reason)) << run.err();
      EXPECT_EQ(says(run.err(), "backtrace in uav_agent-jurong.log"), how != "exits" && how != "hangs") << run.err();
      EXPECT_EQ(says(run.err(), "    #0 "), how != "exits" && how != "hangs") << run.err();
    }
    EXPECT_NE(run.result()["status"], "completed");
    expect_complete_result(run);
    expect_nothing_left();
  }
}

TEST_F(OneProcess, AProgramThatSilentlyEndsOrStopsTheProcessIsNamed) {
  if (!sanitizer().empty()) GTEST_SKIP() << "sanitizers handle the end of a process and its descriptors themselves";
  const std::vector<std::pair<std::string, std::string>> deaths = {{"stops", "is stopped (SIGSTOP)"},
                                                                   {"closes", "closed file descriptors"},
                                                                   {"exits_now", "called _exit()"},
                                                                   {"exits_quickly", "quick_exit()"},
                                                                   {"becomes", "became another one"}};
  for (const auto& [how, reason] : deaths) {
    SCOPED_TRACE(how);
    SkeinRun& run = end_with_jurong(how, {"--threads", "1"});  // with more threads, the culprit is one of two programs
    EXPECT_TRUE(says(run.err(), reason)) << run.err();
    EXPECT_NE(run.result()["status"], "completed");
    expect_nothing_left();
  }
}

TEST_F(OneProcess, WithTwoThreadsTheCulpritOrBothRunningProgramsAreNamed) {
  if (!sanitizer().empty()) GTEST_SKIP() << "sanitizers handle the end of a process themselves";
  SkeinRun& run = this->run("side_by_side", nasty("exits_now", {"--threads", "2"}), {}, 3);
  const bool all = says(run.err(), "is one of uav_agent-");
  EXPECT_TRUE(says(run.err(), all ? "--threads 1 tells which" : "uav_agent-jurong failed: ")) << run.err();
  EXPECT_FALSE(says(run.err(), "uav_agent-changi failed: ")) << run.err();
}

TEST_F(OneProcess, DebugNamesWithoutAReaderAreRefusedAtOnce) {
  for (const auto& [how, reason] : {std::pair("names_badly", "'not fine'"), {"names_many", "at most 64"}}) {
    SkeinRun& run = this->run(how, nasty(how), {}, 2);
    EXPECT_TRUE(says(run.err(), reason)) << run.err();
    EXPECT_TRUE(says(run.err(), "jurong")) << run.err();
  }
}

TEST_F(OneProcess, TheDestructorOfAKilledPlannerDoesNotRun) {
  const auto faults = write("faults.yaml", "faults:\n  - {at_s: 2, kill: jurong}\n");
  const auto last_words = [&](const std::string& name, const Arguments& more) {
    const std::string file = folder() / (name + ".txt");
    EXPECT_EQ(run(name, nasty("none", more), {{"NASTY_WILL", file}}).result()["status"], "completed");
    const std::string text = text_of(file);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(last_words("lives", {}), 2)
      << "planners are destroyed after the check before the flight, and after the flight";
  EXPECT_EQ(last_words("killed", {"--faults", faults}), 1)
      << "only the planner of the check before the flight is destroyed";
}

TEST_F(OneProcess, EachProgramHasALogOfItsOwn) {
  SkeinRun& run = this->run("logs", nasty("none", {"--threads", "2"}));
  const std::string log = text_of(run.dir() / "uav_agent-jurong.log");
  EXPECT_TRUE(says(log, "nasty begins")) << "output of printf is missing: " << log;
  EXPECT_TRUE(says(log, "nasty plans")) << "output of std::cerr is missing: " << log;
  EXPECT_TRUE(says(log, "] info nasty none")) << log;
  for (const auto& entry : std::filesystem::directory_iterator(run.dir())) {
    if (entry.path().extension() != ".log" || entry.path().stem() == "uav_agent-jurong") continue;
    EXPECT_FALSE(says(text_of(entry.path()), "nasty")) << entry.path();
  }
}

TEST_F(OneProcess, EndsWhenTheUserInterruptsIt) {
  SkeinRun& run = start("stopped", flight({"--planner", "patrol", "--clock", "realtime:10"}, "500"));
  ASSERT_TRUE(run.wait_until_flying());
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
  EXPECT_EQ(run.result()["status"], "interrupted");
  expect_complete_result(run);
}

TEST_F(OneProcess, FliesInRealTimeOnRequest) {
  SkeinRun& run = this->run("paced", flight({"--clock", "realtime:10", "--planner", "hover"}));
  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_FALSE(result["deterministic"]);
  EXPECT_LE(result["real_time_factor"].get<double>(), 10.5);
}

}  // namespace
}  // namespace skein::test
