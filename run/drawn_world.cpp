#include "run/drawn_world.hpp"

#include <filesystem>

#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/user_cache.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

namespace fs = std::filesystem;

namespace {

/// The cache folder of a world. Its path has the grammar's version, so Skein uses no world of an older grammar.
fs::path folder_of(const std::string& world) {
  const auto cache = user_cache_folder();
  if (!cache) {
    throw InputError("the scenario '" + world +
                     "' is drawn once and kept: set HOME, or XDG_CACHE_HOME, to a folder where that can be");
  }
  return *cache / "worlds" / ("grammar-" + std::to_string(kWorldGrammar)) / world;
}

/// Whether the cache has the world with all its files: a user, or a tool that cleans caches, may have deleted some.
bool is_kept(const fs::path& scenario) try {
  std::error_code error;
  if (!fs::is_regular_file(scenario, error)) return false;
  load_scenario(scenario);
  return true;
} catch (const InputError&) {
  return false;
}

}  // namespace

std::string scenario_source(const std::string& scenario, const std::optional<std::uint64_t>& scene_seed) {
  if (!is_drawn_world(scenario)) return scenario;
  const std::string seed = std::to_string(scene_seed.value_or(0)), world = scenario + "_" + seed;
  const fs::path folder = folder_of(world), file = folder / (world + ".yaml");
  if (is_kept(file)) return file;
  const ScratchDir scratch;
  const fs::path log = scratch.path() / "draw.log";
  // sim_server gets the environment of a run, so that the libm of runs draws the world. A concurrent process writes the
  // same bytes.
  const ExitStatus exit = run_to_end({programs::kSimServer,
                                      {program_dir() / programs::kSimServer, "--draw-world", scenario, "--scene-seed",
                                       seed, "--export-scene", folder, "--overwrite-export"},
                                      fleet_environment(false),
                                      log});
  if (exit.ok()) return file;
  std::string said;
  for (const std::string& line : last_lines(log, 20)) said += "\n" + line;
  if (exit.code == kExitBadInput) throw InputError(scenario + " " + seed + ":" + said);
  throw std::runtime_error("sim_server --draw-world " + world + " ended with " + exit.text() + said);
}

}  // namespace skein::cli
