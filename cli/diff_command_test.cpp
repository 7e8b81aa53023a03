// What `skein diff` says of two folders, beside their digests.
#include "cli/actions.hpp"

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

  static constexpr const char* kTables[] = {"captures.csv", "events.csv", "score.csv", "score_timeline.csv",
                                            "trajectories.csv"};
  const ScratchFolder folder_;
  std::ostringstream out_;
};

TEST_F(DiffCommand, NamesEachTableThatOnlyOneRunHas) {
  EXPECT_EQ(diff(), kExitDone);
  EXPECT_EQ(out_.str(), "the runs are the same\n");
  for (const char* table : kTables) {
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

TEST_F(DiffCommand, ATableThatNeitherRunHasIsNoDifference) {
  for (const std::string run : {"a", "b"}) std::filesystem::remove(folder_.path() / run / "captures.csv");
  EXPECT_EQ(diff(), kExitDone) << out_.str();
}

TEST_F(DiffCommand, ARunMayHaveNoRecording) {
  write("b", "recording.mcap", "never read");
  EXPECT_EQ(diff(), kExitDone);
  EXPECT_EQ(out_.str(), "the runs are the same\nnot compared: recording.mcap, which only the second run has\n");
}

}  // namespace
}  // namespace skein::cli
