// `skein merge` of a small fleet's reports: it names damaged ones, and replaces no good result by a worse one.
#include "cli/merge_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/program.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

class MergeCommand : public ::testing::Test {
 protected:
  MergeCommand() {
    fs::create_directories(dir());
    write_report("sim_server", {{"status", "completed"},
                                {"sim_time_s", 9.5},
                                {"flight", {{"scenario", programs_.scenario().string()}, {"seed", 3}}}});
    write_report("station", {{"score", 2.5}, {"points_detected", 3}});
    write_report("comm_router", {{"sent", 11}});
    for (const char* agent : {"uav_agent-alpha", "uav_agent-beta"}) write_report(agent, {{"planner", "hover"}});
    options_.dir = dir();
    options_.report = false;
  }

  fs::path dir() const { return programs_.dir() / "run"; }
  fs::path report(const std::string& program) const { return dir() / run_folder::report_file(program); }
  void write_report(const std::string& program, const Json& json) const { write_text(report(program), json.dump()); }
  void truncate(const std::string& program) const { write_text(report(program), "{\"score\": 2."); }
  fs::path result_file() const { return dir() / run_folder::kResult; }

  int merge() {
    err_.str("");
    return merge_reports(options_, {out_, err_, false});
  }
  std::string refusal() try {
    merge();
    return "";
  } catch (const InputError& error) {
    return error.what();
  }

  const FakePrograms programs_;
  MergeOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(MergeCommand, MergingTwiceGivesTheSameResult) {
  EXPECT_EQ(merge(), kExitDone) << err_.str();
  const Json result = results::read_result_file(dir());
  EXPECT_EQ(result["score"], 2.5);
  EXPECT_EQ(result["seed"], 3);
  EXPECT_EQ(merge(), kExitDone) << err_.str();
  EXPECT_EQ(results::read_result_file(dir()), result);
}

TEST_F(MergeCommand, AnInvalidResultIsNamedAndMadeAgain) {
  for (const char* text : {"{}", "[]", "null", R"({"status": "completed", "memory_mb": "9"})"}) {
    write_text(result_file(), text);
    EXPECT_EQ(merge(), kExitDone) << err_.str();
    EXPECT_NE(err_.str().find(result_file().string() + ": is damaged: "), std::string::npos) << text;
    EXPECT_EQ(results::read_result_file(dir())["score"], 2.5) << text;
  }
}

TEST_F(MergeCommand, ADamagedReportIsNamedAndTheResultStays) {
  ASSERT_EQ(merge(), kExitDone) << err_.str();
  const std::string result = read_text(result_file());
  for (const std::string program : {"station", "comm_router", "uav_agent-beta"}) {
    const std::string whole = read_text(report(program));
    truncate(program);
    EXPECT_NE(refusal().find(report(program).string() + ": is damaged"), std::string::npos) << program;
    EXPECT_EQ(read_text(result_file()), result) << program;
    write_text(report(program), whole);
  }
  truncate("sim_server");
  EXPECT_NE(refusal().find(report("sim_server").string() + ": is damaged"), std::string::npos) << refusal();
  EXPECT_EQ(read_text(result_file()), result);
}

TEST_F(MergeCommand, AReportWithoutAKeyOfEveryReportIsDamaged) {
  ASSERT_EQ(merge(), kExitDone) << err_.str();
  const std::string result = read_text(result_file());
  for (const Json& json : {Json::object(), Json{{"score", "x"}}, Json{{"score", -1.0}}}) {
    write_report("station", json);
    EXPECT_NE(refusal().find(report("station").string() + ": is damaged: 'score'"), std::string::npos) << json;
  }
  write_report("station", {{"score", 2.5}});
  for (const Json& json : {Json::object(), Json{{"status", 3}}, Json{{"status", "fine"}}}) {
    write_report("sim_server", json);
    EXPECT_NE(refusal().find(report("sim_server").string() + ": is damaged: 'status'"), std::string::npos) << json;
  }
  EXPECT_EQ(read_text(result_file()), result);
}

TEST_F(MergeCommand, AChangedNumberInAReportIsDamage) {
  const Json sound = with_checksum({{"score", 2.5}, {"points_detected", 3}});
  write_report("station", sound);
  EXPECT_EQ(merge(), kExitDone) << err_.str();
  Json changed = sound;
  changed["score"] = 7.5;
  write_report("station", changed);
  EXPECT_NE(refusal().find(report("station").string() + ": is damaged, or was edited: its checksum"), std::string::npos)
      << refusal();
  EXPECT_EQ(results::read_result_file(dir())["score"], 2.5);
  changed.erase(kChecksum);
  write_report("station", changed);
  EXPECT_EQ(merge(), kExitDone) << "a report without a checksum is accepted, as from an earlier version: "
                                << err_.str();
}

TEST_F(MergeCommand, ADamagedReportIsMadeAgainFromTheJournal) {
  programs_.script("station", "echo '{\"score\": 2.25}' > \"$out/station.report.json\"\n");
  truncate("station");
  write_text(dir() / run_folder::kJournal, "the journal");
  EXPECT_EQ(merge(), kExitDone) << err_.str();
  EXPECT_NE(err_.str().find(report("station").string() + ": is damaged"), std::string::npos) << err_.str();
  EXPECT_EQ(results::read_result_file(dir())["score"], 2.25);

  programs_.script("station", "exit 3\n");
  truncate("station");
  EXPECT_NE(refusal().find(report("station").string() + ": is damaged"), std::string::npos)
      << "the books are damaged, too";
  EXPECT_EQ(results::read_result_file(dir())["score"], 2.25);
}

TEST_F(MergeCommand, AReportThatCannotBeMadeFromTheJournalIsNamed) {
  programs_.script("station", "exit 3\n");
  fs::remove(report("station"));
  write_text(dir() / run_folder::kJournal, "the journal");
  merge();
  EXPECT_NE(err_.str().find(report("station").string() + ": is missing"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("exit code 3"), std::string::npos) << err_.str();
  EXPECT_NE(results::read_result_file(dir())["warnings"].dump().find("station left no report"), std::string::npos);
}

TEST_F(MergeCommand, TheResultIsMadeFromTheReportThatWasChecked) {
  programs_.script("station",
                   "echo '{\"score\": 2.25}' > \"$out/station.report.json\"\n"
                   "echo '{}' > \"$out/sim_server.report.json\"\n");
  truncate("station");
  write_text(dir() / run_folder::kJournal, "the journal");
  EXPECT_EQ(merge(), kExitDone) << err_.str();
  EXPECT_EQ(results::read_result_file(dir())["status"], "completed");
}

// Joining the parts of a recording deletes them. The programs of a flying fleet would go on to write to deleted files.
TEST_F(MergeCommand, TheFolderOfAFleetThatFliesIsLeftAlone) {
  fs::remove(report("sim_server"));
  write_text(dir() / "sim_server.mcap", "unfinished");
  {
    const ResultsDir launcher(dir(), Earlier::keep);
    EXPECT_NE(refusal().find(dir().string() + ": a launcher is writing there now"), std::string::npos) << refusal();
  }
  EXPECT_EQ(read_text(dir() / "sim_server.mcap"), "unfinished");
  options_.dir = dir() / "nowhere";
  EXPECT_NE(refusal().find("there is no such folder"), std::string::npos) << refusal();
  EXPECT_FALSE(fs::exists(options_.dir));
}

TEST_F(MergeCommand, DamagedTablesAreNamedAndTheCommandFails) {
  ASSERT_EQ(merge(), kExitDone) << err_.str();
  write_text(dir() / run_folder::kScoreTimeline, "time_s,points,score\n1,2,3\n2,x,3\n");
  EXPECT_EQ(merge(), kExitCheckFailed);
  EXPECT_NE(err_.str().find("score_timeline.csv is readable only up to row 1 ("), std::string::npos) << err_.str();
  EXPECT_EQ(results::read_result_file(dir())["score"], 2.5) << "the result needs only the reports";
}

TEST_F(MergeCommand, TheKeysThatOnlyTheLauncherWritesStay) {
  const Json launchers = {{"command", "skein run small.yaml"},
                          {"startup_s", 0.5},
                          {"memory_mb", 90.0},
                          {"processes", {{"station", {{"cpu_s", 1}}}}}};
  Json before = launchers;
  before["score"] = 1.5;
  write_text(result_file(), results::result_text(before));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(merge(), kExitDone) << err_.str();
    const Json result = results::read_result_file(dir());
    EXPECT_EQ(result["score"], 2.5) << "the score is that of the station's report";
    for (const auto& [key, value] : launchers.items()) EXPECT_EQ(result[key], value) << key;
  }
  std::string damaged = read_text(result_file());
  damaged.replace(damaged.find("2.5"), 3, "9.5");
  write_text(result_file(), damaged);
  EXPECT_EQ(merge(), kExitDone) << err_.str();
  EXPECT_NE(err_.str().find(result_file().string() + ": is damaged"), std::string::npos) << err_.str();
  EXPECT_EQ(results::read_result_file(dir())["score"], 2.5);
  EXPECT_FALSE(results::read_result_file(dir()).contains("command"));
}

}  // namespace
}  // namespace skein::cli
