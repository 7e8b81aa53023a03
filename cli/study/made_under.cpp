#include "cli/study/made_under.hpp"

#include <vector>

#include "core/files/file_bytes.hpp"
#include "core/planners/python_spec.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/sha256.hpp"
#include "results/run_folder.hpp"
#include "run/python_planners.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFile = 2'000'000'000;

/// Digest of the programs that fly with every planner. The launcher is left out, because it only supervises.
std::string digest_of_servers(const fs::path& bin_dir) {
  Sha256 hash;
  for (const char* name : programs::kServers) hash.add(read_file_bytes(bin_dir / name, kLargestFile));
  return hash.hex();
}

/// The file that a planner takes its parameters from, if any: "kios:mine.yaml,voxel_m=4".
std::optional<fs::path> parameter_file(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos || exec_command(spec)) return std::nullopt;
  const fs::path file = spec.substr(colon + 1, spec.find(',', colon) - colon - 1);
  return fs::is_regular_file(file) ? std::optional(file) : std::nullopt;
}

/// Digest of the scenario with all its vehicles and files, of the planners' files, and of the fault file.
std::string input_digest(const FleetPlan& plan) {
  const SceneConfig& scene = plan.scenario.scene;
  Sha256 hash;
  hash.add(to_yaml(plan.scenario));
  std::vector<fs::path> files = scene.meshes;
  if (from_files(scene)) files.insert(files.end(), {scene.points, scene.boxes});
  std::vector<std::string> specs;
  for (const UavPlanner& planner : plan.planners) specs.push_back(planner.spec);
  if (plan.ground) specs.push_back(plan.ground->spec);
  for (const std::string& spec : specs) {
    if (const auto python = python_spec(spec)) {
      hash.add(python_digest(python->file));
      if (fs::is_regular_file(python->parameters)) files.push_back(python->parameters);
    }
    if (const auto file = parameter_file(spec)) files.push_back(*file);
  }
  if (plan.options.faults) files.push_back(*plan.options.faults);
  for (const fs::path& file : files) hash.add(read_file_bytes(file, kLargestFile));
  return hash.hex();
}

}  // namespace

std::string medium_of(const FleetPlan& fleet) { return fleet.options.one_process ? "one process" : fleet.options.dds; }

Json MadeUnder::of(const FleetPlan& fleet) {
  if (programs_.empty()) programs_ = digest_of_servers(fleet.bin_dir);
  return {{"skein_version", SKEIN_VERSION},   {"programs", programs_},
          {"agent", agent_digest(fleet)},     {"scenario", fleet.options.scenario},
          {"planner", fleet.options.planner}, {"input", input_digest(fleet)},
          {"dds", medium_of(fleet)}};
}

/// Digest of all agent programs of a fleet. If there is only one, it is that program's own digest.
std::string MadeUnder::agent_digest(const FleetPlan& fleet) {
  if (fleet.options.one_process) return digest(fleet_file(fleet));
  const std::vector<fs::path> agents = agent_files(fleet);
  if (agents.size() == 1) return digest(agents.front());
  Sha256 hash;
  for (const fs::path& agent : agents) hash.add(digest(agent));
  return hash.hex();
}

const std::string& MadeUnder::digest(const fs::path& agent) {
  std::string& digest = digests_[agent];
  if (digest.empty()) digest = Sha256().add(read_file_bytes(agent, kLargestFile)).hex();
  return digest;
}

}  // namespace skein::cli
