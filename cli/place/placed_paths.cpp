#include "cli/place/placed_paths.hpp"

#include <algorithm>

#include "core/planners/python_spec.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"
#include "run/program_files.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

fs::path plain(const fs::path& file) { return fs::absolute(file).lexically_normal(); }

/// A file's path on the other host. Files keep their places relative to each other, so references between them hold.
fs::path there_of(const fs::path& file, const HostFolders& there) {
  return there.root / "files" / plain(file).relative_path();
}

/// A planner's spec, with the paths that its files have on the other host.
std::string spec_there(const UavPlanner& planner, const HostFolders& there) {
  std::string spec = planner.spec;
  const fs::path parameters = parameter_file(planner);
  if (!parameters.empty()) {
    spec = spec.substr(0, spec.size() - parameters.string().size()) + there_of(parameters, there).string();
  }
  if (const auto python = python_spec(planner.spec)) {
    const std::size_t at = spec.find(python->file.string());
    if (at != std::string::npos) spec.replace(at, python->file.string().size(), there_of(python->file, there).string());
  }
  return spec;
}

/// The variables of a program beyond those that every program of the fleet gets.
std::map<std::string, std::string> own_variables(const ProgramSpec& spec, bool native) {
  const std::vector<std::string> usual = fleet_environment(native);
  std::map<std::string, std::string> own;
  for (const std::string& entry : spec.env) {
    if (std::ranges::find(usual, entry) != usual.end()) continue;
    const std::string name(variable_in(entry));
    own[name] = entry.substr(name.size() + 1);
  }
  return own;
}

class Translation {
 public:
  Translation(const FleetPlan& plan, const std::string& program, const HostFolders& there)
      : plan_(plan), program_(program), there_(there) {}

  std::string value(const std::string& option, const std::string& text) {
    if (option == "--out" || option == "SKEIN_OUT" || option == "HOME") return out();
    if (option == "--security" || option == "SKEIN_SECURITY") return keys(text);
    if (option == "--planner") return spec_there(planner_of(plan_, program_), there_);
    if (option == "SKEIN_CONFIG_DIR") return there_.config;
    if (option == "SKEIN_BIN_DIR") return there_.bin;
    const bool file = option == "--scenario" || option == "--faults" || option == "SKEIN_SCENARIO";
    return file ? there_of(text, there_).string() : text;
  }
  void copy(const fs::path& file) { result.files[there_of(file, there_)] = plain(file); }

  PlacedProgram result;

 private:
  std::string out() const { return there_.root / "out" / program_; }
  std::string keys(const fs::path& folder) {
    result.keys = there_.root / "keys" / program_;
    for (const auto& entry : fs::directory_iterator(folder)) {
      result.files[result.keys / entry.path().filename()] = entry.path();
    }
    return result.keys;
  }

  const FleetPlan& plan_;
  const std::string program_;
  const HostFolders& there_;
};

}  // namespace

PlacedProgram place_program(const FleetPlan& plan, const ProgramSpec& spec, const HostFolders& there,
                            const std::string& network) {
  Translation translation(plan, spec.name, there);
  for (const fs::path& file : scenario_files(plan, spec.name)) translation.copy(file);
  if (plan.options.faults) translation.copy(*plan.options.faults);
  for (const fs::path& file : planner_files(plan, spec.name)) translation.copy(file);
  const bool exec = is_exec(plan, spec.name);
  std::vector<std::string> argv = spec.argv;
  for (std::size_t i = 1; !exec && i + 1 < argv.size(); ++i) argv[i + 1] = translation.value(argv[i], argv[i + 1]);
  const fs::path agent = exec ? fs::path() : agent_file(plan, spec.name);
  if (agent == plan.bin_dir / programs::kAgent) {
    argv[0] = there.bin / programs::kAgent;
  } else if (!exec) {
    translation.copy(agent);
    argv[0] = there_of(agent, there);
  }
  std::map<std::string, std::string> variables = own_variables(spec, plan.options.native);
  for (auto& [name, value] : variables) value = translation.value(name, value);
  if (exec) variables["SKEIN_NETWORK"] = network;
  PlacedProgram placed = std::move(translation.result);
  placed.argv = std::move(argv);
  placed.variables = std::move(variables);
  return placed;
}

}  // namespace skein::cli
