// Files that a run reads must not be among those that it first deletes from its results folder.
#include "run/inputs_outlast.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// A results folder with files of an earlier run, and a folder beside it.
class InputsOutlast : public ::testing::Test {
 protected:
  InputsOutlast() {
    fs::create_directories(dir_ / "planner_files" / "1");
    fs::create_directories(beside_);
    for (const char* name : {"by-hand.yaml", "recording.mcap", "hand-alpha.csv", "my.yaml", "planner_files/1/fly.py"}) {
      write_text(dir_ / name, "x\n");
    }
    write_text(beside_ / "by-hand.yaml", "faults: []\n");
  }
  std::string refusal(const fs::path& file) const try {
    check_outlast({file}, dir_);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }

  const FakePrograms programs_;
  const fs::path dir_ = programs_.dir() / "out", beside_ = programs_.dir() / "beside";
};

TEST_F(InputsOutlast, AFileThatTheRunWouldDeleteIsNamed) {
  for (const char* name : {"by-hand.yaml", "recording.mcap", "hand-alpha.csv", "planner_files/1/fly.py"}) {
    EXPECT_EQ(refusal(dir_ / name).find((dir_ / name).string() + ": "), 0U) << name;
  }
  EXPECT_NE(refusal(dir_ / "planner_files" / ".." / "by-hand.yaml"), "");
  fs::create_symlink(dir_ / "by-hand.yaml", beside_ / "leads-there.yaml");
  fs::create_directory_symlink(dir_, beside_ / "folder");
  EXPECT_NE(refusal(beside_ / "leads-there.yaml"), "");
  EXPECT_NE(refusal(beside_ / "folder" / "recording.mcap"), "");
  fs::create_symlink(beside_ / "by-hand.yaml", dir_ / "events.csv");
  EXPECT_NE(refusal(dir_ / "events.csv"), "") << "the run would delete the link";
}

TEST_F(InputsOutlast, OtherFilesAreIgnored) {
  EXPECT_EQ(refusal(dir_ / "my.yaml"), "") << "a run does not delete files of this name";
  EXPECT_EQ(refusal(beside_ / "by-hand.yaml"), "");
  EXPECT_EQ(refusal(dir_ / "captures.csv"), "") << "the file does not exist";
  EXPECT_EQ(refusal({}), "");
  EXPECT_NO_THROW(check_outlast({dir_ / "by-hand.yaml"}, programs_.dir() / "not_there_yet"));
}

TEST_F(InputsOutlast, AllFilesOfAPlanAreChecked) {
  const fs::path recording = dir_ / "recording.mcap", hand = dir_ / "hand-alpha.csv", faults = dir_ / "by-hand.yaml";
  const auto plan = [&](const std::function<void(RunOptions&)>& change) {
    RunOptions options;
    options.scenario = programs_.scenario();
    options.planner = "hover";
    change(options);
    return plan_fleet(options, programs_.dir());
  };
  const auto refused = [&](const FleetPlan& plan) {
    EXPECT_THROW(check_inputs_outlast(plan, dir_), InputError);
    EXPECT_NO_THROW(check_inputs_outlast(plan, beside_ / "out"));
  };
  EXPECT_NO_THROW(check_inputs_outlast(plan([](RunOptions&) {}), dir_));
  refused(plan([&](RunOptions& options) { options.replay = ReplayOf{recording, {}, {}, {}}; }));
  refused(plan([&](RunOptions& options) { options.planner = "hover,alpha=hand:" + hand.string(); }));
  refused(plan([&](RunOptions& options) { options.planner = "hover,alpha=hand:safe=false,file=" + hand.string(); }));
  write_text(faults, "faults:\n  - {at_s: 8, until_s: 20, station_outage: true}\n");
  refused(plan([&](RunOptions& options) { options.faults = faults; }));
  write_text(dir_ / "metadata.yaml", "height_m: 4\n");
  refused(plan([&](RunOptions& options) { options.planner = "hover:" + (dir_ / "metadata.yaml").string(); }));
  write_text(dir_ / "station.yaml", kSmallScenario);
  refused(plan([&](RunOptions& options) { options.scenario = dir_ / "station.yaml"; }));
}

}  // namespace
}  // namespace skein::cli
