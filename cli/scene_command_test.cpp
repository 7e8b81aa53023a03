#include "cli/scene_command.hpp"

#include <gtest/gtest.h>

#include "cli/testing/fake_programs.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

class SceneCommand : public ::testing::Test {
 protected:
  FakePrograms programs_;
};

TEST_F(SceneCommand, HandsItsOptionsToTheServer) {
  const std::filesystem::path told = programs_.dir() / "told";
  write_script(programs_.dir() / "sim_server", "echo \"$@\" > " + told.string());
  EXPECT_EQ(export_scene({.scenario = "towers", .out = "there"}), kExitDone);
  EXPECT_EQ(read_text(told), "--scenario towers --export-scene there\n");
  EXPECT_EQ(export_scene({.scenario = "mine.yaml", .scene_seed = 7, .out = "there", .assets = "assets", .force = true}),
            kExitDone);
  EXPECT_EQ(read_text(told),
            "--scenario mine.yaml --export-scene there --scene-seed 7 --assets assets --overwrite-export\n");
  EXPECT_EQ(export_scene({.scenario = "towers", .picture = true}), kExitDone);
  EXPECT_EQ(read_text(told), "--scenario towers --scene-picture .\n");
}

TEST_F(SceneCommand, ItsExitCodeIsOurs) {
  write_script(programs_.dir() / "sim_server", "exit 2");
  EXPECT_EQ(export_scene({.scenario = "towers", .out = "there"}), kExitBadInput);
  write_script(programs_.dir() / "sim_server", "kill -9 $$");
  EXPECT_EQ(export_scene({.scenario = "towers", .out = "there"}), kExitProcessFailed);
}

}  // namespace
}  // namespace skein::cli
