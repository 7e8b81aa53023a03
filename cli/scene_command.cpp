#include "cli/scene_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/text/number_checks.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/drawn_world.hpp"
#include "run/fleet_plan.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {

void add_scene(CLI::App& app, SceneOptions& scene) {
  CLI::App* command = app.add_subcommand("scene", "Write a scene as STL, PCD and boxes, with a scenario that flies it");
  command->add_option("SCENARIO", scene.scenario, "A name under config/scenarios/ or a YAML file")->required();
  command->add_option("--scene-seed", scene.scene_seed, "Number of the variant of a procedural scenario")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--uavs", scene.uavs, "Fleet size, as for `skein run`")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  command->add_option("--out", scene.out, "Folder for the files of the scene and its scenario");
  command->add_flag("--picture", scene.picture,
                    "Draw the scene as SCENARIO.svg, in the folder of --out or the current one");
  command->add_option("--assets", scene.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_flag("--force", scene.force, "Overwrite an earlier export");
  command->callback([&scene] {
    if (!scene.out && !scene.picture) {
      throw InputError("scene: give --out FOLDER to write the scene, --picture to draw it, or both");
    }
  });
  command->footer(
      "Examples:\n"
      "  skein scene towers --scene-seed 3 --out my_scene\n"
      "  skein scene wild --scene-seed 7 --picture");
}

namespace {

/// Keeps launchers out of the folder while the scene is written, and the scene out of the folder of a fleet that flies.
/// @returns nullopt if there is no such folder yet. @throws InputError if a launcher uses the folder
std::optional<FolderLock> lock_of_export(const std::filesystem::path& folder) try {
  std::error_code error;  // ignored: the server reports what is wrong with the folder
  if (!std::filesystem::is_directory(folder, error)) return std::nullopt;
  return std::optional<FolderLock>(std::in_place, folder);
} catch (const FolderInUse&) {
  throw InputError("--out " + folder.string() + ": a launcher is writing there now; choose another folder");
}

}  // namespace

int export_scene(const SceneOptions& options) {
  const std::optional<FolderLock> lock = options.out ? lock_of_export(*options.out) : std::nullopt;
  std::vector<std::string> argv = {program_dir() / programs::kSimServer, "--scenario",
                                   scenario_source(options.scenario, options.scene_seed, options.uavs)};
  if (options.out) argv.insert(argv.end(), {"--export-scene", *options.out});
  if (options.picture) argv.insert(argv.end(), {"--scene-picture", options.out.value_or(".")});
  if (options.scene_seed) argv.insert(argv.end(), {"--scene-seed", std::to_string(*options.scene_seed)});
  if (options.uavs) argv.insert(argv.end(), {"--uavs", std::to_string(*options.uavs)});
  if (options.assets) argv.insert(argv.end(), {"--assets", *options.assets});
  if (options.force) argv.push_back("--overwrite-export");
  // With a run's environment, hence the same libm and the same scene.
  return hand_over({programs::kSimServer, argv, fleet_environment(false), {}});
}

}  // namespace skein::cli
