#include "cli/study/made_under.hpp"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <vector>

#include "core/files/file_bytes.hpp"
#include "core/planners/python_spec.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/sha256.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
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

/// The words of a command for a shell. A command with operators or variables is only split at them.
std::vector<std::string> rough_words(const std::string& command) try {
  return shell_words(command);
} catch (const InputError&) {
  constexpr const char* kEnds = " \t\n;|&<>()$`'\"";
  std::vector<std::string> words;
  for (std::size_t at = command.find_first_not_of(kEnds); at != std::string::npos;) {
    const std::size_t end = command.find_first_of(kEnds, at);
    words.push_back(command.substr(at, end - at));
    at = command.find_first_not_of(kEnds, end);
  }
  return words;
}

/// The files that a command names: its program, and scripts or data among its arguments.
std::vector<fs::path> files_of_command(const std::string& command) {
  std::vector<fs::path> files;
  for (const std::string& word : rough_words(command)) {
    std::error_code error;
    if (fs::is_regular_file(word, error)) files.emplace_back(word);
  }
  return files;
}

/// What a flight reads beside programs and scenario.
struct InputFiles {
  std::vector<std::string> python;  ///< digests of planners in Python
  std::vector<fs::path> files;
};

/// The files of the scene, of the planners, and the fault file.
InputFiles input_files(const FleetPlan& plan) {
  const SceneConfig& scene = plan.scenario.scene;
  InputFiles input{{}, scene.meshes};
  std::vector<fs::path>& files = input.files;
  if (from_files(scene)) files.insert(files.end(), {scene.points, scene.boxes});
  std::vector<std::string> specs;
  for (const UavPlanner& planner : plan.planners) specs.push_back(planner.spec);
  if (plan.ground) specs.push_back(plan.ground->spec);
  for (const std::string& spec : specs) {
    if (const auto python = python_spec(spec)) {
      input.python.push_back(python_digest(python->file));
      if (fs::is_regular_file(python->parameters)) files.push_back(python->parameters);
    }
    if (const auto file = parameter_file(spec)) files.push_back(*file);
    if (const auto command = exec_command(spec))
      std::ranges::copy(files_of_command(*command), std::back_inserter(files));
  }
  if (plan.options.faults) files.push_back(*plan.options.faults);
  return input;
}

void add_to(Sha256& hash, const InputFiles& input) {
  for (const std::string& digest : input.python) hash.add(digest);
  for (const fs::path& file : input.files) hash.add(read_file_bytes(file, kLargestFile));
}

/// Digest of the scenario with all its vehicles, and of all input files.
std::string input_digest(const FleetPlan& plan) {
  Sha256 hash;
  hash.add(to_yaml(plan.scenario));
  add_to(hash, input_files(plan));
  return hash.hex();
}

}  // namespace

std::optional<std::string> input_files_digest(const FleetPlan& fleet) {
  const InputFiles input = input_files(fleet);
  if (input.python.empty() && input.files.empty()) return std::nullopt;
  Sha256 hash;
  add_to(hash, input);
  return hash.hex();
}

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
