// A run does not start if it would delete files that it reads.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "cli/run_command.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

TEST(RunInputs, ARunThatWouldDeleteItsInputsDoesNotStart) {
  const FakePrograms programs;
  const std::filesystem::path dir = programs.dir() / "out";
  std::filesystem::create_directory(dir);
  for (const char* name : {"recording.mcap", "hand-alpha.csv"}) write_text(dir / name, "x\n");
  RunOptions options;
  options.scenario = programs.scenario();
  options.planner = "hover";
  options.out = dir;
  options.force = true;
  options.replay = ReplayOf{dir / "recording.mcap", {}, {}, {}};
  std::ostringstream out, err;
  EXPECT_THROW(run_fleet(options, {out, err, false}), InputError);
  EXPECT_EQ(read_text(dir / "recording.mcap"), "x\n");
  EXPECT_TRUE(std::filesystem::exists(dir / "hand-alpha.csv")) << "nothing was deleted";
}

}  // namespace
}  // namespace skein::cli
