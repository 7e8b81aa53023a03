// The folder of a study: without --force, no file in it is lost.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/sweep/folder.hpp"
#include "cli/testing/study_commands.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// The texts of all files of a study, by path.
std::map<std::string, std::string> texts_below(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) texts[entry.path()] = read_text(entry.path());
  }
  return texts;
}

TEST_F(StudyCommand, OtherSettingsInTheSameFolderAreRefusedUnlessForced) {
  ASSERT_EQ(run(), kExitDone);
  options_.planner_lists = {"hover,patrol", "kios"};
  EXPECT_NE(refusal().find("planners: then hover, patrol, now hover, patrol, kios"), std::string::npos) << refusal();
  EXPECT_EQ(flown(), "");
  options_.force = true;
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(flown(), "kios 1\nkios 2\nkios 3\n") << "the other results fit";
  options_.duration_s = 30.0;
  options_.force = false;
  EXPECT_NE(refusal().find("duration_s: then null, now 30"), std::string::npos) << refusal();
  options_.duration_s.reset();
  programs_.script("station", "# another build\n");
  EXPECT_NE(refusal().find("built anew"), std::string::npos) << refusal();
  options_.force = true;
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(std::ranges::count(flown(), '\n'), 9) << "flights of another build do not count";
}

// Results of other programs do not fit, so a command that was only to add a planner must not fly everything again.
TEST_F(StudyCommand, ARefusedCommandWithAnotherPlannerLeavesTheFolderAsItIs) {
  ASSERT_EQ(run(), kExitDone) << err_.str();
  const auto before = texts_below(*options_.out);
  options_.planner_lists = {"hover,patrol,kios"};
  programs_.script("station", "# another build\n");
  const std::string message = refusal();
  for (const char* part : {"planners: then hover, patrol, now hover, patrol, kios", "the programs were built anew",
                           "Nothing was changed. Choose another --out, or continue there with --force",
                           "and the others are flown again in their place"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_EQ(flown(), "");
  EXPECT_EQ(texts_below(*options_.out), before);
  options_.planner_lists = {"hover,patrol"};
  programs_.script("station", "");
  EXPECT_EQ(run(), kExitDone) << "the study itself goes on";
  EXPECT_EQ(flown(), "");
}

// `skein --flight` may refuse a flight before it empties the results folder.
TEST_F(StudyCommand, ARefusedFlightLeavesNoFormerResultThatCounts) {
  ASSERT_EQ(run(), kExitDone) << err_.str();
  programs_.script("station", "# another build\n");
  hook("if [ $seed = 2 ] && [ $planner = hover ]; then exit 2; fi\n");
  options_.force = true;
  EXPECT_EQ(run(), kExitProcessFailed);
  EXPECT_NE(file("flights.csv").find(",hover,2,,"), std::string::npos) << file("flights.csv");
}

// A user who asks for the status has not asked for flights.
TEST_F(StudyCommand, TheStatusAfterAnotherBuildTellsWhichResultsFitAndWhatContinuingDoes) {
  ASSERT_EQ(run(), kExitDone) << err_.str();
  const std::string out = *options_.out;
  for (const bool forced : {false, true}) {
    SweepSettings sweep;
    sweep.token = "token";
    sweep.reference = {0, *options_.out / "reference", RunOptions{}, Json::object()};
    sweep.command = {"contest",    "--planners", "hover,patrol", "--scenarios", programs_.scenario(),
                     "--executor", "local",      "--tests",      "3",           "--out",
                     out};
    if (forced) sweep.command.emplace_back("--force");
    sweep.working_folder = fs::current_path();
    SweepFolder(*options_.out).write_settings(sweep);
    const auto before = texts_below(*options_.out);
    programs_.script("station", "# another build\n");
    options_.sweep.status = *options_.out;
    const std::string message = refusal();
    EXPECT_EQ(message.find(out + " holds a study with other settings:\n  the programs were built anew\nNothing was"),
              0U)
        << message;
    for (const char* part : {"--status only shows a study", "the programs and files with which it was flown",
                             "If you continue the study", "No flight fits after the programs were built anew."}) {
      EXPECT_NE(message.find(part), std::string::npos) << message;
    }
    EXPECT_EQ(flown(), "");
    EXPECT_EQ(texts_below(*options_.out), before);
  }
}

TEST_F(StudyCommand, AFolderOfARunIsRefused) {
  fs::create_directories(*options_.out);
  write_text(*options_.out / "result.json", "{}");
  EXPECT_NE(refusal().find("holds a result already"), std::string::npos);
}

TEST_F(StudyCommand, AFolderOfOtherFilesIsLeftAsItIsUnlessForced) {
  const auto figures = *options_.out / "figures";
  fs::create_directories(figures);
  EXPECT_NE(refusal().find("--out " + options_.out->string() + ": 'figures' exists and belongs to no study"),
            std::string::npos)
      << refusal();
  write_text(figures / "mine.svg", "a drawing");
  write_text(*options_.out / "flights.csv", "mine");
  EXPECT_NE(refusal().find("--force"), std::string::npos) << refusal();
  EXPECT_EQ(flown(), "");
  EXPECT_EQ(file("flights.csv"), "mine");
  EXPECT_EQ(file("figures/mine.svg"), "a drawing");
  EXPECT_FALSE(fs::exists(*options_.out / "study.json"));
  write_text(*options_.out / "study.json", "{\"planners\": [");
  EXPECT_NE(refusal().find("study.json: is damaged"), std::string::npos) << refusal();
  fs::remove(*options_.out / "study.json");
  write_text(*options_.out / "scene.json", "mine, too");
  options_.force = true;
  EXPECT_EQ(run(), kExitDone);
  EXPECT_EQ(file("scene.json"), "mine, too") << "a study has no file of this name";
  options_.force = false;
  EXPECT_EQ(run(), kExitDone) << "now the folder is that of a study";
}

// Slurm opens the log of a job before the job begins. A launcher that was killed leaves the file that reserved space
// for its result.
TEST_F(StudyCommand, AnEmptyFolderAndOneWithTheLogOfItsJobAreAccepted) {
  const std::vector<std::string> logs = {"slurm-17.out", "slurm-17_3.out", "job.log", "job.err"};
  fs::create_directories(*options_.out);
  EXPECT_EQ(run(), kExitDone) << err_.str();
  options_.out = programs_.dir() / "logs";
  fs::create_directories(*options_.out);
  for (const std::string& log : logs) write_text(*options_.out / log, "mine");
  write_text(*options_.out / "result.json.tmp-room", "");
  EXPECT_EQ(run(), kExitDone) << err_.str();
  for (const std::string& log : logs) EXPECT_EQ(file(log), "mine") << log;
}

}  // namespace
}  // namespace skein::cli
