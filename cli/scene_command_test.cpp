#include "cli/scene_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/program.hpp"
#include "run/results_dir.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

SceneOptions of(const std::string& scenario) {
  SceneOptions options;
  options.scenario = scenario;
  return options;
}

class SceneCommand : public ::testing::Test {
 protected:
  FakePrograms programs_;
};

TEST_F(SceneCommand, HandsItsOptionsToTheServer) {
  const std::filesystem::path told = programs_.dir() / "told";
  write_script(programs_.dir() / "sim_server", "echo \"$@\" > " + told.string());
  SceneOptions files = of("towers");
  files.out = "there";
  EXPECT_EQ(export_scene(files), kExitDone);
  EXPECT_EQ(read_text(told), "--scenario towers --export-scene there\n");
  files.scenario = "mine.yaml";
  files.scene_seed = 7;
  files.assets = "assets";
  files.force = true;
  EXPECT_EQ(export_scene(files), kExitDone);
  EXPECT_EQ(read_text(told),
            "--scenario mine.yaml --export-scene there --scene-seed 7 --assets assets --overwrite-export\n");
  SceneOptions picture = of("towers");
  picture.picture = true;
  EXPECT_EQ(export_scene(picture), kExitDone);
  EXPECT_EQ(read_text(told), "--scenario towers --scene-picture .\n");
}

TEST_F(SceneCommand, AFolderThatALauncherUsesIsRefused) {
  const std::filesystem::path told = programs_.dir() / "told";
  write_script(programs_.dir() / "sim_server", "echo \"$@\" > " + told.string());
  const ScratchFolder folder;
  SceneOptions files = of("towers");
  files.out = folder.path();
  files.force = true;
  {
    const ResultsDir launcher(folder.path(), Earlier::keep);
    try {
      export_scene(files);
      ADD_FAILURE() << "written";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(),
                "--out " + folder.path().string() + ": a launcher is writing there now; choose another folder");
    }
    EXPECT_FALSE(std::filesystem::exists(told)) << "the server was started";
  }
  EXPECT_EQ(export_scene(files), kExitDone);
}

TEST_F(SceneCommand, TheCommandReturnsTheServersExitCode) {
  write_script(programs_.dir() / "sim_server", "exit 2");
  EXPECT_EQ(export_scene(of("towers")), kExitBadInput);
  write_script(programs_.dir() / "sim_server", "kill -9 $$");
  EXPECT_EQ(export_scene(of("towers")), kExitProcessFailed);
}

}  // namespace
}  // namespace skein::cli
