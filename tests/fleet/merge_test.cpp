// `skein merge` makes the result that a launcher would write, from the files of programs that ran without a launcher.
#include <signal.h>

#include <fstream>
#include <random>

#include "by_hand_fixture.hpp"
#include "json_schema.hpp"
#include "results/run_folder.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// Keys that only a launcher can fill: it measures the programs' resources, and knows when it started them.
const std::vector<std::string> kOnlyTheLaunchers = {"startup_s", "processes", "memory_mb"};
/// Measured values, which differ between flights.
const std::vector<std::string> kMeasured = {"wall_time_s", "real_time_factor", "timing"};
const std::vector<std::string> kMeasuredOfUavs = {"planner_cpu_s", "planner_cpu_p99_ms", "planner_cpu_max_ms",
                                                  "planner_exchanges_over_50ms"};

/// A result without the values that differ between flights, or between merge and launcher.
Json comparable(Json result) {
  result.erase("checksum");  // it also covers measured values
  result.erase("command");   // without the launcher there is no command
  for (const auto* keys : {&kOnlyTheLaunchers, &kMeasured}) {
    for (const std::string& key : *keys) result.erase(key);
  }
  for (Json& uav : result["uavs"]) {
    for (const std::string& key : kMeasuredOfUavs) uav.erase(key);
  }
  return result;
}

class Merge : public ByHand {
 protected:
  static constexpr const char* kDuration_s = "60";

  void fly(Arguments more = {}, const std::string& scenario = "towers") {
    more.insert(more.end(), {"--duration", kDuration_s});
    start_fleet({.scenario = scenario, .all = more});
    for (const auto& [name, process] : fleet_) process->wait();
  }
  SkeinRun& launch(const Arguments& more = {}) {
    Arguments arguments = {"towers", "--planner", "patrol", "--duration", kDuration_s};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("launched", arguments);
  }
  ChildProcess& merge(const Arguments& more = {}) {
    Arguments arguments = {"merge", dir_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return skein(arguments);
  }
  /// Merges; the result must conform to the schema.
  Json merged(const Arguments& more = {}) {
    ChildProcess& process = merge(more);
    EXPECT_EQ(process.wait().code, 0) << process.err();
    return result();
  }
  Json result() const {
    const Json result = Json::parse(text_of(dir_ / run_folder::kResult), nullptr, false);
    const Json schema = Json::parse(text_of(source_path("docs/result.schema.json")));
    for (const std::string& error : schema_errors(result, schema)) ADD_FAILURE() << error;
    return result;
  }
  fs::path report(const std::string& program) const { return dir_ / run_folder::report_file(program); }
};

TEST_F(Merge, GivesTheResultOfTheLauncher) {
  const Arguments options = {
      "--seed",    "5",        "--rules",
      "reference", "--faults", write("faults.yaml", "faults:\n  - {at_s: 8, until_s: 20, station_outage: true}\n")};
  const Json launched = launch(options).result();
  fly(options);
  const Json result = merged();
  EXPECT_EQ(comparable(result), comparable(launched)) << Json::diff(comparable(launched), comparable(result));
  EXPECT_GT(result["score"], 0.0);
  for (const std::string& key : kOnlyTheLaunchers)
    EXPECT_TRUE(result.contains(key)) << "merge must write the key, for programs that read it: " << key;
  EXPECT_TRUE(fs::exists(dir_ / run_folder::kScore));
  EXPECT_EQ(text_of(dir_ / run_folder::kScore), text_of(folder() / "launched" / run_folder::kScore));
}

TEST_F(Merge, ProgramsWithoutAReportAreReported) {
  fly();
  const Json whole = merged();
  fs::remove(report("uav_agent-sentosa"));
  const Json result = merged();
  ASSERT_EQ(result["warnings"].size(), whole["warnings"].size() + 1) << result["warnings"];
  EXPECT_NE(result["warnings"].dump().find("uav_agent-sentosa left no report"), std::string::npos);
  for (const char* key : {"score", "digest", "score_by_uav", "radio", "collisions"}) {
    EXPECT_EQ(result[key], whole[key]) << key;
  }
  for (const Json& uav : result["uavs"]) EXPECT_EQ(uav["planner_cpu_s"].is_null(), uav["name"] == "sentosa");
}

TEST_F(Merge, AStationThatAFaultKilledForGoodGetsItsScoreFromTheJournal) {
  const Arguments options = {"--faults", write("faults.yaml", "faults:\n  - {at_s: 47, kill: station}\n")};
  const Json launched = launch(options).result();
  fly({options[0], options[1], "--keep"});
  EXPECT_FALSE(fs::exists(report("station"))) << "a station that is killed for good writes no report, only its journal";
  Json result = merged();
  EXPECT_GT(result["score"], 0.0);
  result["dds"]["station"] = launched["dds"]["station"];  // the journal does not contain it
  EXPECT_EQ(comparable(result), comparable(launched)) << Json::diff(comparable(launched), comparable(result));
}

TEST_F(Merge, DamagedReportsAreMergedOrRefusedWithAMessage) {
  fly();
  const Json whole = merged();
  std::map<fs::path, std::string> texts;
  for (const std::string& name : kPrograms) texts[report(name)] = text_of(report(name));
  std::mt19937 random{std::random_device{}()};
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  for (int round = 0; round < 16 && !HasFailure(); ++round) {
    for (const auto& [file, text] : texts) std::ofstream(file) << text;
    const fs::path victim = report(kPrograms[round < 8 ? 0 : below(kPrograms.size())]);
    std::string text = texts.at(victim);
    if (below(2) == 0) {
      text.resize(below(text.size()));
    } else {
      for (int i = 0; i < 5; ++i) text[below(text.size())] = "0\"{}[],:-e"[below(10)];
    }
    SCOPED_TRACE(victim.filename().string() + ": " + text);
    std::ofstream(victim) << text;
    fs::remove(dir_ / run_folder::kResult);
    ChildProcess& process = merge();
    const ExitStatus exit = process.wait();
    EXPECT_EQ(exit.signal, 0);
    EXPECT_TRUE(exit.code == 0 || exit.code == 2 || exit.code == 3) << exit.code;
    EXPECT_FALSE(process.err().empty() && process.out().empty());
    EXPECT_EQ(fs::exists(dir_ / run_folder::kResult), exit.code != 2) << process.err();
    if (exit.code != 2) result();
  }
}

TEST_F(Merge, WithoutAServersReportThereIsNothingToMerge) {
  const auto expect_refused = [&](const char* reason) {
    ChildProcess& process = merge();
    EXPECT_EQ(process.wait().code, 2);
    EXPECT_NE(process.err().find(reason), std::string::npos) << process.err();
    EXPECT_FALSE(fs::exists(dir_ / run_folder::kResult));
  };
  expect_refused("sim_server.report.json");
  std::ofstream(report("sim_server")) << "[]";
  expect_refused("sim_server.report.json");
  fs::remove_all(dir_);
  expect_refused("there is no such folder");
}

// The files of a launcher that was killed with all its programs.
TEST_F(Merge, WithoutAServersReportTheRecordingsPartsAreJoined) {
  fly();
  fs::remove(report("sim_server"));
  ASSERT_TRUE(fs::exists(dir_ / run_folder::recording_part("sim_server", 0)));
  fs::remove(dir_ / run_folder::recording_part("station", 0));
  ChildProcess& process = merge();
  EXPECT_EQ(process.wait().code, 3) << process.err();
  EXPECT_TRUE(fs::exists(dir_ / run_folder::kRecording));
  EXPECT_NE(process.out().find("joined from sim_server.mcap comm_router.mcap"), std::string::npos) << process.out();
  EXPECT_NE(process.err().find("missing: what station recorded"), std::string::npos) << process.err();
  EXPECT_NE(process.err().find("missing: result.json"), std::string::npos) << process.err();
  EXPECT_FALSE(fs::exists(dir_ / run_folder::kResult));
}

TEST_F(Merge, ReportsOfAgentsInContainersAreTakenFromTheirFolders) {
  fly();
  const Json whole = merged();
  const fs::path folder = dir_ / "agents" / "sentosa";
  fs::create_directories(folder);
  fs::rename(report("uav_agent-sentosa"), folder / report("uav_agent-sentosa").filename());
  std::ofstream(folder / report("sim_server").filename()) << "forged";
  EXPECT_EQ(comparable(merged()), comparable(whole));
  EXPECT_TRUE(fs::exists(report("uav_agent-sentosa")));
  EXPECT_FALSE(fs::exists(dir_ / "agents"));
}

TEST_F(Merge, ADamagedPartIsReportedAndNotMadeIntoARecording) {
  fly();
  const fs::path part = dir_ / run_folder::recording_part("sim_server", 0);
  std::string bytes = text_of(part);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  std::ofstream(part, std::ios::binary) << bytes;
  ChildProcess& process = merge();
  EXPECT_EQ(process.wait().code, 1) << process.err();
  EXPECT_NE(process.err().find("sim_server.mcap: "), std::string::npos) << process.err();
  EXPECT_NE(result()["warnings"].dump().find("no recording.mcap, but its parts: sim_server.mcap: "), std::string::npos);
  EXPECT_FALSE(fs::exists(dir_ / run_folder::kRecording));
  EXPECT_TRUE(fs::exists(part));
}

TEST_F(Merge, AScenarioMayHaveMovedSinceItWasFlown) {
  const fs::path flown = write("flown.yaml", text_of(source_path("config/scenarios/towers.yaml"))),
                 moved = folder() / "elsewhere" / "moved.yaml";
  fly({}, flown);
  const Json whole = merged();
  fs::create_directories(moved.parent_path());
  fs::rename(flown, moved);
  ChildProcess& process = merge();
  EXPECT_EQ(process.wait().code, 2);
  EXPECT_NE(process.err().find("--scenario FILE"), std::string::npos) << process.err();
  Json result = merged({"--scenario", moved});
  EXPECT_EQ(result["scenario"], moved.string());
  result["scenario"] = whole["scenario"];
  EXPECT_EQ(comparable(result), comparable(whole)) << Json::diff(comparable(whole), comparable(result));
}

}  // namespace
}  // namespace skein::test
