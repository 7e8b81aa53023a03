#include "cli/actions.hpp"

#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/drawn_world.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

int export_scene(const SceneOptions& options) {
  std::vector<std::string> argv = {program_dir() / programs::kSimServer, "--scenario",
                                   scenario_source(options.scenario, options.scene_seed)};
  if (options.out) argv.insert(argv.end(), {"--export-scene", *options.out});
  if (options.picture) argv.insert(argv.end(), {"--scene-picture", options.out.value_or(".")});
  if (options.scene_seed) argv.insert(argv.end(), {"--scene-seed", std::to_string(*options.scene_seed)});
  if (options.assets) argv.insert(argv.end(), {"--assets", *options.assets});
  if (options.force) argv.push_back("--overwrite-export");
  // With a run's environment, hence the same libm and the same scene.
  return hand_over({programs::kSimServer, argv, fleet_environment(false), {}});
}

}  // namespace skein::cli
