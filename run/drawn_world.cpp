#include "run/drawn_world.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

#include "core/files/file_bytes.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/sha256.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
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
                     "' is generated once and stored in a cache: set HOME or XDG_CACHE_HOME to a folder for it");
  }
  return *cache / "worlds" / ("grammar-" + std::to_string(kWorldGrammar)) / world;
}

constexpr std::uintmax_t kMostOfAWorldFile = 1 << 30;

/// The file beside a world's scenario with the checksum of its files.
fs::path checksum_file(const fs::path& scenario) { return fs::path(scenario).replace_extension(".sha256"); }

/// A line with a SHA-256 over the scenario and the files of its scene. @throws InputError when one is missing.
std::string checksum_of(const fs::path& scenario) {
  const SceneConfig scene = load_scenario(scenario).scene;
  std::vector<fs::path> files = scene.meshes;
  files.insert(files.end(), {scenario, scene.points, scene.boxes});
  Sha256 hash;
  for (const fs::path& file : files) hash.add(read_file_bytes(file, kMostOfAWorldFile));
  return hash.hex() + "\n";
}

/// Whether the cache has the world with all its files, as they were drawn: a user, or a tool that cleans caches, may
/// have deleted some, and a disk may have cut some short.
bool is_kept(const fs::path& scenario) try {
  return read_file_bytes(checksum_file(scenario), kMostOfAWorldFile) == checksum_of(scenario);
} catch (const InputError&) {
  return false;
}

/// Whether the cache has a world with all its files and without a checksum: an earlier version drew it, or the checksum
/// could not be written.
bool is_kept_without_checksum(const fs::path& scenario) try {
  std::error_code error;
  if (!fs::is_regular_file(scenario, error) || fs::exists(checksum_file(scenario), error)) return false;
  load_scenario(scenario);
  return true;
} catch (const InputError&) {
  return false;
}

/// Writes the checksum of a world. If that fails, the world is drawn again the next time.
void keep_checksum(const fs::path& scenario) try {
  write_file_atomically(checksum_file(scenario), checksum_of(scenario), Readers::no_agents);
} catch (const std::exception&) {  // a file is missing, as the run will report, or the disk is full
}

}  // namespace

std::string scenario_source(const std::string& scenario, const std::optional<std::uint64_t>& scene_seed,
                            const std::optional<std::size_t>& uavs) {
  if (!is_drawn_world(scenario)) return scenario;
  const std::string seed = std::to_string(scene_seed.value_or(0));
  std::string world = scenario + "_" + seed;
  std::vector<std::string> size;
  if (scenario == kDistrict) {
    if (uavs && (*uavs < 1 || *uavs > kMostUavs)) {
      throw InputError("--uavs: must be within [1, " + std::to_string(kMostUavs) + "]");
    }
    const std::string count = std::to_string(uavs.value_or(kUsualDistrictUavs));
    world += "_" + count;
    size = {"--uavs", count};
  }
  const fs::path folder = folder_of(world), file = folder / (world + ".yaml");
  if (is_kept(file)) return file;
  const ScratchDir scratch;
  const fs::path log = scratch.path() / "draw.log";
  // sim_server gets the environment of a run, so that the libm of runs draws the world. A concurrent process writes the
  // same bytes.
  std::vector<std::string> arguments = {program_dir() / programs::kSimServer,
                                        "--draw-world",
                                        scenario,
                                        "--scene-seed",
                                        seed,
                                        "--export-scene",
                                        folder,
                                        "--overwrite-export"};
  arguments.insert(arguments.end(), size.begin(), size.end());
  const ExitStatus exit = run_to_end({programs::kSimServer, arguments, fleet_environment(false), log});
  if (exit.ok()) {
    keep_checksum(file);
    return file;
  }
  // If the cache is read-only, a world without a checksum cannot be drawn again: it flies as it is.
  if (exit.code == kExitBadInput && is_kept_without_checksum(file)) return file;
  std::string said;
  for (const std::string& line : last_lines(log, 20)) said += "\n" + line;
  if (exit.code == kExitBadInput) throw InputError(scenario + " " + seed + ":" + said);
  throw std::runtime_error("sim_server --draw-world " + world + " ended with " + exit.text() + said);
}

Scenario scenario_flown(const RunOptions& options, bool needs_scene_files) {
  LoadOptions load = load_options(options);
  load.needs_scene_files = needs_scene_files;
  return load_scenario(scenario_source(options.scenario, options.scene_seed, options.uavs), load);
}

}  // namespace skein::cli
