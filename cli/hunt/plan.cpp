#include "cli/hunt/plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/hunt/weather_faults.hpp"
#include "cli/study/made_under.hpp"
#include "core/config/config_writer.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/files/file_bytes.hpp"
#include "core/scenario/conditions.hpp"
#include "core/text/sha256.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/machine.hpp"
#include "host/preflight.hpp"
#include "run/agent_file.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using properties::PropertyEntries;
using properties::PropertyEntry;

/// Mission time after the longest deadline. Near the end of a mission, a UAV without time for more work hovers where it
/// has a link, and waits. A UAV whose program restarts far from home begins to wait long before the end.
constexpr double kAfterDeadline_s = 40.0;
constexpr double kLeastForFaults_s = 5.0;
constexpr double kPatience_s = 300.0;  ///< wall time; many flights at once make each one slow, which is not a failure
constexpr std::size_t kBuildLetters = 12;
constexpr std::uintmax_t kLargestAgent = 2'000'000'000;

/// The ready properties that hunts evaluate by default, without those that do not fit this scenario.
PropertyEntries usual_entries(const Scenario& scenario) {
  PropertyEntries entries;
  for (const std::string& name : properties::ready_property_names()) {
    if (!properties::load_ready_property(name).in_hunts) continue;
    const PropertyEntries one = {{name, PropertyEntry("ready")}};
    try {
      properties::parse_properties(one, scenario);
    } catch (const InputError&) {
      continue;  // it needs more UAVs, or a longer mission
    }
    entries.push_back(one.front());
  }
  return entries;
}

/// The properties of the user's file. @throws InputError if one has the name of a finding that every hunt has: their
/// outcomes would be mistaken for each other.
PropertyEntries entries_in(const fs::path& file) {
  PropertyEntries entries = properties::load_property_entries(file);
  for (const auto& [name, entry] : entries) {
    if (name != kCompletes && name != kSameDigest) continue;
    throw InputError(file.string() + ": properties." + name +
                     ": every hunt has a finding of this name; give the property another one");
  }
  return entries;
}

PropertyEntries entries_of(const HuntOptions& options, const Scenario& scenario) {
  PropertyEntries entries = options.properties ? entries_in(*options.properties) : usual_entries(scenario);
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries) names.push_back(name);
  for (const std::string& name : options.without) {
    if (std::ranges::find(names, name) == names.end()) {
      throw InputError("--without: there is no property '" + name + "' in this hunt; " + suggestion(name, names));
    }
    std::erase_if(entries, [&](const auto& entry) { return entry.first == name; });
  }
  return entries;
}

std::vector<std::string> kinds_of(const HuntOptions& options) {
  for (const std::string& kind : options.faults) {
    if (std::ranges::find(fault_kinds(), kind) == fault_kinds().end()) {
      throw InputError("--faults: there is no fault '" + kind + "'; " + suggestion(kind, fault_kinds()));
    }
  }
  return options.faults.empty() ? fault_kinds() : options.faults;
}

void check_conditions(const HuntOptions& options, const Scenario& scenario) {
  for (const std::string& conditions : options.conditions) {
    try {
      chosen_conditions(conditions, scenario.conditions);
    } catch (const InputError& error) {
      throw InputError("--conditions " + conditions + ": " + error.what());
    }
  }
}

/// @throws InputError for a kind in `--faults` that no run of the hunt can have.
void check_kinds(const HuntOptions& options, const Scenario& scenario) {
  for (const std::string& kind : options.faults) {
    const auto possible = [&](const std::string& conditions) {
      return is_possible(kind, chosen_conditions(conditions, scenario.conditions));
    };
    const bool here = options.conditions.empty() ? is_possible(kind, scenario.conditions)
                                                 : std::ranges::any_of(options.conditions, possible);
    if (here) continue;
    throw InputError("--faults: no run of this hunt can have the fault '" + kind +
                     "'; fly under conditions that have it, as with --conditions breezy");
  }
}

Json settings_of(const HuntPlan& plan) {
  const RunOptions& run = plan.fleet.options;
  Json settings{{"skein_version", SKEIN_VERSION},  {"scenario", to_yaml(plan.fleet.scenario)},
                {"planner", run.planner},          {"scene_seed", run.scene_seed ? Json(*run.scene_seed) : Json()},
                {"one_process", plan.one_process}, {"dds", run.dds},
                {"seed", plan.options.seed},       {"faults", plan.space.kinds},
                {"properties", Json::object()},    {"programs", programs_digest(plan.fleet)}};
  // The usual number is left out, so that hunts of earlier versions can be continued.
  if (plan.options.round != kUsualRound) settings["round"] = plan.options.round;
  if (const auto inputs = input_files_digest(plan.fleet)) settings["inputs"] = *inputs;
  if (!plan.options.conditions.empty()) settings["conditions"] = plan.options.conditions;
  for (const auto& [name, entry] : plan.entries) {
    settings["properties"][name] = flow_text(ConfigWriter::node_of(entry).value_or(ConfigNode{}));
  }
  return settings;
}

RunOptions run_options_of(const HuntOptions& options) {
  RunOptions run = options.run;
  run.attainable = run.report = run.check = false;
  run.force = true;
  run.record = "messages";
  if (!run.agent_timeout_s) run.agent_timeout_s = kPatience_s;
  return run;
}

}  // namespace

std::string programs_digest(const FleetPlan& fleet) {
  Sha256 hash;
  std::vector<fs::path> files = {fleet.bin_dir / programs::kSimServer, fleet.bin_dir / programs::kCommRouter,
                                 fleet.bin_dir / programs::kStation};
  if (fleet.options.one_process) files = {fleet_file(fleet)};
  const std::vector<fs::path> agents = agent_files(fleet);
  files.insert(files.end(), agents.begin(), agents.end());
  for (const fs::path& file : files) hash.add(read_file_bytes(file, kLargestAgent));
  return hash.hex();
}

std::string build_of(const HuntPlan& plan) {
  return plan.settings.at("programs").get<std::string>().substr(0, kBuildLetters);
}

double longest_deadline_s(const properties::PropertySet& set) {
  double longest_s = 0.0;
  for (const properties::NamedProperty& property : set) {
    for (const properties::Property& one : property.cases) {
      if (one.window.from == properties::Window::From::heal) {
        longest_s = std::max(longest_s, one.window.within_s.value_or(0.0));
      }
    }
  }
  return longest_s;
}

HuntPlan plan_hunt(const HuntOptions& options) {
  RunOptions run = run_options_of(options);
  const Processes processes = options.dds ? Processes::as_given : Processes::one_if_possible;
  HuntPlan plan{options, plan_fleet(run, program_dir(), processes), {}, {}};
  plan.one_process = plan.fleet.options.one_process;
  if (!options.jobs) plan.options.jobs = plan.one_process ? usable_cores() : 1;
  if (options.dds) plan.fleet.options.dds = *options.dds;
  if (options.properties) properties::load_properties(*options.properties, plan.fleet.scenario);  // names error lines
  plan.entries = entries_of(options, plan.fleet.scenario);
  plan.space.kinds = kinds_of(options);
  check_conditions(options, plan.fleet.scenario);
  check_kinds(options, plan.fleet.scenario);
  plan.space.ground_program = plan.fleet.ground.has_value();
  const double duration_s = plan.fleet.scenario.duration_s;
  const double deadline_s = longest_deadline_s(properties::parse_properties(plan.entries, plan.fleet.scenario));
  plan.space.heal_by_s = std::floor(duration_s - deadline_s - kAfterDeadline_s);
  if (plan.space.heal_by_s < kLeastForFaults_s) {
    throw InputError("--duration: a mission of " + number_text(duration_s) +
                     " s has no time for faults: properties that must hold after the last fault have up to " +
                     number_text(deadline_s) + " s, and the last " + number_text(kAfterDeadline_s) +
                     " s are for the flight home; the shortest mission for these properties is " +
                     number_text(std::ceil(deadline_s + kAfterDeadline_s + kLeastForFaults_s)) + " s");
  }
  plan.out = options.out.value_or(
      fs::path("runs") / ("hunt-" + plan.fleet.scenario.name + "-" + fs::path(run.planner).filename().string()));
  plan.settings = settings_of(plan);
  return plan;
}

std::string capsule_text(const std::string& name, const Trial& trial, const CapsuleMark& mark, const std::string& told,
                         const PropertyEntries& entries) {
  const RunOptions& run = trial.run;
  ConfigNode flown = ConfigNode::make_map();
  const auto add = [&flown](const std::string& key, const auto& value) {
    if (const auto node = ConfigWriter::node_of(value)) flown.add(key, *node);
  };
  const bool is_file = run.scenario.find('/') != std::string::npos || run.scenario.ends_with(".yaml");
  add("scenario", is_file ? fs::absolute(run.scenario).string() : run.scenario);
  add("planner", run.planner);
  add("seed", run.seed);
  add("scene_seed", run.scene_seed);
  add("uavs", run.uavs);
  add("duration_s", run.duration_s);
  add("conditions", run.conditions);
  std::string text =
      "# fault test\n# " + printable(told) + "\nname: " + name + "\nrun: " + flow_text(flown) + "\n" + trial.text();
  const auto entry = std::ranges::find(entries, mark.property, [](const auto& one) { return one.first; });
  if (entry != entries.end()) {
    ConfigNode node = ConfigWriter::node_of(entry->second).value_or(ConfigNode{});
    if (node.kind == ConfigNode::Kind::scalar && node.scalar != "ready") node.quoted = true;
    text += "properties:\n  " + mark.property + ": " + flow_text(node) + "\n";
  }
  if (mark.property == kSameDigest) text += "expect: {same_digest: [one_process]}\n";
  text += "capsule: " + flow_text(ConfigWriter::node_of(mark).value_or(ConfigNode{})) + "\n";
  return text;
}

}  // namespace skein::cli
