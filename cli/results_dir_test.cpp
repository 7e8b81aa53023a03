#include "cli/results_dir.hpp"

#include <gtest/gtest.h>

#include "cli/fake_programs.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

TEST(ResultsDir, DefaultNameTellsTheRun) {
  EXPECT_EQ(default_results_dir("towers", "patrol", 3), "runs/towers-patrol-3");
  EXPECT_EQ(default_results_dir("towers", "a=b:c/d", 0), "runs/towers-a_b_c_d-0");
}

TEST(ResultsDir, IsCreatedWithItsParents) {
  const ScratchDir scratch;
  const ResultsDir dir(scratch.path() / "a/b", false);
  EXPECT_TRUE(fs::is_directory(dir.path()));
}

TEST(ResultsDir, AnExistingResultIsKeptUnlessForced) {
  const ScratchDir scratch;
  write_text(scratch.path() / "result.json", "{}");
  EXPECT_THROW(ResultsDir::check(scratch.path(), false), InputError);
  EXPECT_THROW(ResultsDir(scratch.path(), false), InputError);
  EXPECT_TRUE(fs::exists(scratch.path() / "result.json"));
  ResultsDir::check(scratch.path(), true);
  EXPECT_TRUE(fs::exists(scratch.path() / "result.json"));
  const ResultsDir dir(scratch.path(), true);
  EXPECT_FALSE(fs::exists(scratch.path() / "result.json"));
}

TEST(ResultsDir, OnlyWhatARunWritesIsRemoved) {
  const ScratchDir scratch;
  const auto of_runs = {"station.report.json", "station.journal", "comm_router.counts",      "uav_agent-alpha.log",
                        "digests.csv",         "scene.json",      "station.report.json.tmp7", "result.json.tmp1234"};
  const auto of_others = {"notes.txt", "my.log", "station-notes.txt", "mine.tmp7"};
  for (const char* name : of_runs) write_text(scratch.path() / name, "x");
  for (const char* name : of_others) write_text(scratch.path() / name, "x");
  const ResultsDir dir(scratch.path(), false);
  for (const char* name : of_runs) EXPECT_FALSE(fs::exists(scratch.path() / name)) << name;
  for (const char* name : of_others) EXPECT_TRUE(fs::exists(scratch.path() / name)) << name;
}

TEST(ResultsDir, TwoRunsNeverShareAFolder) {
  const ScratchDir scratch;
  {
    const ResultsDir first(scratch.path(), false);
    EXPECT_THROW(ResultsDir(scratch.path(), false), InputError);
  }
  const ResultsDir second(scratch.path(), false);
}

TEST(ResultsDir, AFileIsNoFolder) {
  const ScratchDir scratch;
  write_text(scratch.path() / "file", "");
  EXPECT_THROW(ResultsDir(scratch.path() / "file", true), InputError);
  EXPECT_THROW(ResultsDir(scratch.path() / "file/below", true), InputError);
}

TEST(ResultsDir, ANameThatCannotBeIsTheUsersMistake) {
  const ScratchDir scratch;
  fs::create_symlink(scratch.path() / "b", scratch.path() / "a");
  fs::create_symlink(scratch.path() / "a", scratch.path() / "b");
  for (const fs::path& dir : {scratch.path() / "a", scratch.path() / "a/below", scratch.path() / std::string(5000, 'x')}) {
    EXPECT_THROW(ResultsDir(dir, false), InputError) << dir;
    EXPECT_THROW(ResultsDir(dir, true), InputError) << dir;
  }
}

}  // namespace
}  // namespace skein::cli
