// The differences between two folders that `skein diff` reports in addition to their digests.
#include "cli/diff_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/types.hpp"
#include "process/program.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

class DiffCommand : public ::testing::Test {
 protected:
  DiffCommand() {
    for (const std::string run : {"a", "b"}) {
      std::filesystem::create_directory(folder_.path() / run);
      write(run, "digests.csv", "k,digest\n0,aa\n1,bb\n");
      for (const char* table : kTables) write(run, table, "one,two\n1,2\n");
    }
  }

  void write(const std::string& run, const std::string& file, const std::string& text) const {
    std::ofstream(folder_.path() / run / file) << text;
  }
  int diff() {
    out_.str("");
    std::ostringstream unseen;
    return diff_runs({folder_.path() / "a", folder_.path() / "b"}, {out_, unseen});
  }

  /// The result of a run with this command.
  static std::string result_of(const std::string& command) {
    return R"({"status": "completed", "command": ")" + command + "\"}";
  }

  static constexpr const char* kTables[] = {"captures.csv", "events.csv", "score.csv", "score_timeline.csv",
                                            "trajectories.csv"};
  const ScratchFolder folder_;
  std::ostringstream out_;
};

TEST_F(DiffCommand, AnInvalidResultIsRefusedWithItsFileAndKey) {
  write("a", "result.json", result_of("skein run towers"));
  write("b", "result.json", "{}");
  try {
    diff();
    ADD_FAILURE() << "the runs were compared";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), (folder_.path() / "b/result.json").string() +
                                ": is damaged: status: is missing, so it is not the result of a run");
  }
}

TEST_F(DiffCommand, NamesEachFileThatOnlyOneRunHas) {
  EXPECT_EQ(diff(), kExitDone);
  EXPECT_EQ(out_.str(), "the runs are the same\n");
  std::vector<const char*> files(std::begin(kTables), std::end(kTables));
  for (const char* file : {"activity.csv", "capture_messages.csv", "scene.json", "tracking.csv"}) {
    files.push_back(file);
    for (const std::string run : {"a", "b"}) write(run, file, "");
  }
  for (const char* table : files) {
    for (const std::string run : {"a", "b"}) {
      std::filesystem::remove(folder_.path() / run / table);
      EXPECT_EQ(diff(), kExitCheckFailed) << table;
      const std::string owner = run == "a" ? "second" : "first";
      EXPECT_NE(out_.str().find(std::string(table) + ": only in the " + owner + " run"), std::string::npos)
          << out_.str();
      write(run, table, "one,two\n1,2\n");
    }
  }
}

TEST_F(DiffCommand, DifferentInputsAreReportedFirst) {
  const std::string inputs =
      "the runs had different inputs:\n"
      "  result.json: seed 1, and 2\n"
      "  result.json: conditions \"breeze\", and \"harsh\"\n";
  write("a", "result.json", R"({"status": "completed", "seed": 1, "conditions": "breeze"})");
  write("b", "result.json", R"({"status": "completed", "seed": 2, "conditions": "harsh"})");
  EXPECT_EQ(diff(), kExitCheckFailed);
  EXPECT_EQ(out_.str(), inputs + "the results are the same\n");
  write("b", "digests.csv", "k,digest\n0,aa\n1,cc\n");
  EXPECT_EQ(diff(), kExitCheckFailed);
  EXPECT_TRUE(out_.str().starts_with(inputs + "first difference at step 1 (")) << out_.str();
}

// Messages cut long values, so two objects that differ at their ends would look the same.
TEST_F(DiffCommand, ObjectsAreComparedKeyByKey) {
  const std::string scores = R"({"status": "completed", "score_by_uav": {"alpha": 1.25, "zulu": )";
  write("a", "result.json", scores + "2.5}}");
  write("b", "result.json", scores + R"(3.5, "zz": 0.5}})");
  EXPECT_EQ(diff(), kExitCheckFailed);
  EXPECT_EQ(out_.str(),
            "the digests are the same, but other results differ:\n"
            "  result.json: score_by_uav.zulu 2.5, and 3.5\n"
            "  result.json: score_by_uav.zz null, and 0.5\n");
}

TEST_F(DiffCommand, ATableThatNeitherRunHasIsNoDifference) {
  for (const std::string run : {"a", "b"}) std::filesystem::remove(folder_.path() / run / "captures.csv");
  EXPECT_EQ(diff(), kExitDone) << out_.str();
}

// `skein diff` says that a recording is missing if one of the two runs has lost it.
TEST_F(DiffCommand, ARunThatHasLostItsRecordingIsNotTheSame) {
  for (const std::string run : {"a", "b"}) {
    const std::string owner = run == "a" ? "first" : "second";
    write(run, "recording.mcap", "never read");
    for (const std::string command :
         {"", "skein run towers", "skein run towers --record=messages", "skein run --no-such",
          "skein compose towers --record=all", "skein 'run", "skein"}) {
      for (const std::string one : {"a", "b"}) write(one, "result.json", result_of(command));
      EXPECT_EQ(diff(), kExitCheckFailed) << command;
      EXPECT_NE(out_.str().find("  recording.mcap: only in the " + owner + " run\n"), std::string::npos) << out_.str();
    }
    for (const std::string one : {"a", "b"}) std::filesystem::remove(folder_.path() / one / "result.json");
    EXPECT_EQ(diff(), kExitCheckFailed) << "the result does not say that the run was to record nothing";
    std::filesystem::remove(folder_.path() / run / "recording.mcap");
  }
  EXPECT_EQ(diff(), kExitDone) << "neither run has a recording";
}

TEST_F(DiffCommand, ARunThatWasToldToRecordNothingNeedsNoRecording) {
  for (const std::string run : {"a", "b"}) {
    const std::string other = run == "a" ? "b" : "a", owner = run == "a" ? "first" : "second";
    write(run, "recording.mcap", "never read");
    write(run, "result.json", result_of("skein run towers"));
    for (const std::string command :
         {"run towers --record=none", "run --record --record=none x", "compose --record=none --no-such"}) {
      write(other, "result.json", result_of("skein " + command));
      EXPECT_EQ(diff(), kExitDone) << out_.str();
      EXPECT_EQ(out_.str(), "the runs are the same\nnot compared: recording.mcap, which only the " + owner +
                                " run has; the other one was told to record nothing\n");
    }
    std::filesystem::remove(folder_.path() / run / "recording.mcap");
  }
}

}  // namespace
}  // namespace skein::cli
