#include "cli/check_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "cli/fault_tests/fault_test.hpp"
#include "cli/tell_errors.hpp"
#include "core/config/config_node.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/drawn_world.hpp"
#include "run/fleet_plan.hpp"
#include "run/fleet_programs.hpp"
#include "signals/properties/property_file.hpp"

namespace skein::cli {
namespace {

enum class FileKind { scenario, vehicle, waypoints, faults, fault_test, properties };

/// Told by the first key that only one kind of file has, so that a file that lacks a required key is still recognised.
FileKind kind_of(const std::string& file) {
  static const std::map<std::string, FileKind> kTellingKeys = {
      {"fleet", FileKind::scenario},       {"scene", FileKind::scenario},  {"desired_mm_per_pixel", FileKind::scenario},
      {"role", FileKind::vehicle},         {"mass_kg", FileKind::vehicle}, {"camera", FileKind::vehicle},
      {"lidar", FileKind::vehicle},        {"paths", FileKind::waypoints}, {"faults", FileKind::faults},
      {"properties", FileKind::properties}};
  const ConfigNode root = read_config_document(file).root;
  if (is_fault_test(root)) return FileKind::fault_test;
  for (const std::string& key : root.keys) {
    const auto found = kTellingKeys.find(key);
    if (found != kTellingKeys.end()) return found->second;
  }
  throw InputError(
      file + ":1: is a file of an unknown kind: a scenario has the keys 'scene' and 'fleet', a vehicle 'role', a " +
      "file for the waypoints planner 'paths', a fault file 'faults', a fault test also 'run', a file "
      "of properties 'properties'");
}

/// Lets the programs themselves check a plan, and prints their warnings.
void check_with_programs(const FleetPlan& plan, const Console& console) {
  const ScratchDir scratch;
  for (const std::string& warning : run_checks(check_programs(plan, scratch.path()))) {
    console.err << warning << std::endl;
  }
}

void check_with_programs(const CheckOptions& options, const std::string& scenario, const std::string& planner,
                         const Console& console) {
  RunOptions run;
  run.scenario = scenario;
  run.planner = planner;
  run.assets = options.assets;
  run.agent = options.agent;
  check_with_programs(plan_fleet(run, program_dir(), Processes::one_if_possible), console);
}

/// @returns the name of the scenario that a file was checked with.
std::string checked_with(const CheckOptions& options, const auto& check) {
  RunOptions run;
  run.scenario = options.scenario;
  run.assets = options.assets;
  run.conditions = options.conditions;
  const Scenario scenario = scenario_flown(run, false);  // only the fleet and the times matter
  check(scenario);
  return scenario.name;
}

std::string check_fault_test(const CheckOptions& options, const std::filesystem::path& file, const Console& console) {
  const FaultTest test = load_fault_test(file, options.assets, options.agent);
  try {
    check_with_programs(test.plan, console);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": run: " + error.what());
  }
  return test.plan.scenario.name;
}

std::string check_file(const CheckOptions& options, const std::string& file, const Console& console) {
  const std::string path = std::filesystem::absolute(file);
  switch (kind_of(file)) {
    case FileKind::vehicle:
      load_vehicle(path, default_config_dir());
      return "vehicle";
    case FileKind::waypoints:
      check_with_programs(options, RunOptions{}.scenario, "waypoints:" + path, console);
      return "waypoints";
    case FileKind::scenario:
      check_with_programs(options, path, kDefaultPlanner, console);
      return "scenario";
    case FileKind::faults:
      return "fault file, with " + checked_with(options, [&](const Scenario& s) { load_fault_plan(path, s); });
    case FileKind::properties:
      return "properties, with " +
             checked_with(options, [&](const Scenario& s) { properties::load_properties(path, s); });
    case FileKind::fault_test:
      return "fault test, with " + check_fault_test(options, path, console);
  }
  return {};
}

/// Like check_file(), but each error names the file. The programs' own messages about a scenario may not name it.
std::string named_check(const CheckOptions& options, const std::string& file, const Console& console) try {
  return check_file(options, file, console);
} catch (const InputError& error) {
  const std::string text = error.what(), name = std::filesystem::path(file).filename();
  if (text.find(name) != std::string::npos) throw;
  throw InputError(file + ": " + text);
}

/// Lets sim_server, which contains the production code, check reference vectors. Its output and its exit code become
/// those of this command.
int check_golden(const std::string& file) {
  return hand_over({programs::kSimServer,
                    {program_dir() / programs::kSimServer, "--golden", std::filesystem::absolute(file)},
                    fleet_environment(false),
                    {}});
}

/// Whether the options `--scenario` and `--conditions` have an effect on this file, as far as it can be read.
bool takes_scenario(const std::string& file) try {
  const FileKind kind = kind_of(file);
  return kind == FileKind::faults || kind == FileKind::properties;
} catch (const InputError&) {
  return true;
}

}  // namespace

void add_check(CLI::App& app, CheckOptions& check) {
  CLI::App* command = app.add_subcommand(
      "check", "Check scenarios, vehicles, fault files and fault tests, or compare reference vectors with the code");
  command->add_option("FILE", check.files, "YAML files of these kinds");
  command->add_option("--golden", check.golden, "Compare these reference vectors (CSV) with what the code computes");
  command->add_option("--assets", check.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--agent", check.agent,
                      "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command->add_option("--scenario", check.scenario, "Scenario of fault files that do not name one")
      ->capture_default_str();
  command->add_option("--conditions", check.conditions,
                      "Conditions of fault files that do not name a scenario: none, breezy, harsh, ...");
  command->footer(
      "Examples:\n"
      "  skein check my_scenario.yaml my_vehicle.yaml my_faults.yaml\n"
      "  skein check my_faults.yaml --scenario cranes");
}

void finish_check(CheckOptions& check, const std::vector<std::string>& /*arguments*/) {
  if (check.files.empty() && check.golden.empty()) throw InputError("check: give files, or --golden FILE.csv");
}

int check_files(const CheckOptions& options, const Console& console) {
  int worst = kExitDone;
  const auto take = [&](const auto& check) { worst = std::max(worst, tell_errors(console, check)); };
  for (const std::string& file : options.files) {
    take([&] {
      const std::string kind = named_check(options, file, console);
      console.out << file << ": OK (" << kind << ")" << std::endl;
      return kExitDone;
    });
  }
  for (const std::string& file : options.golden) take([&] { return check_golden(file); });
  const bool given = options.conditions || options.scenario != CheckOptions{}.scenario;
  if (given && std::ranges::none_of(options.files, takes_scenario)) {
    take([]() -> int {
      throw InputError("--scenario and --conditions are for fault files and properties, and no FILE is of these kinds");
    });
  }
  return worst;
}

}  // namespace skein::cli
