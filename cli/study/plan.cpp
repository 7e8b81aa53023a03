#include "cli/study/plan.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <thread>

#include "cli/study/made_under.hpp"
#include "cli/study/spec.hpp"
#include "core/planners/python_spec.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "results/run_folder.hpp"
#include "run/agent_file.hpp"
#include "run/fleet_plan.hpp"
#include "run/fleet_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

void refuse_doubles(const std::string& what, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) throw InputError(what + " '" + name + "' is named twice");
  }
}

/// The planner with the whole paths of its agent and of its file in Python: one text for each planner.
std::string with_whole_paths(const std::string& planner) {
  const auto whole = [](const fs::path& agent) { return fs::weakly_canonical(agent).string(); };
  std::string text = with_agents_named(planner, whole);
  auto python = python_spec(text);
  if (!python) return text;
  python->file = fs::weakly_canonical(python->file);
  return text_of(*python);
}

std::vector<std::string> planners_of(const StudyOptions& options) {
  std::vector<std::string> planners;
  for (const std::string& list : options.planner_lists) {
    for (std::string& planner : split_planners(list)) planners.push_back(std::move(planner));
  }
  planners.insert(planners.end(), options.planners.begin(), options.planners.end());
  if (planners.empty()) throw InputError("which planners? Give them as --planners A,B");
  std::vector<std::string> whole;
  for (const std::string& planner : planners) whole.push_back(with_whole_paths(planner));
  refuse_doubles("planner", whole);
  return planners;
}

std::vector<std::string> scenarios_of(const StudyOptions& options) {
  std::vector<std::string> scenarios = options.scenarios;
  if (scenarios.empty() && !options.contest) scenarios = {RunOptions{}.scenario};
  if (scenarios.empty()) scenarios = contest_scenarios(options.assets.has_value());
  refuse_doubles("scenario", scenarios);
  return scenarios;
}

/// The values of --uavs as texts.
std::vector<std::string> fleet_sizes(const StudyOptions& options) {
  std::vector<std::string> sizes;
  for (const std::size_t uavs : options.uavs) sizes.push_back(std::to_string(uavs));
  return sizes;
}

/// The values of an option that may be left out, each as optional: one nullopt if it is.
template <class T>
std::vector<std::optional<T>> each_or_none(const std::vector<T>& values) {
  if (values.empty()) return {std::nullopt};
  return {values.begin(), values.end()};
}

/// Lists each scenario with each scene seed and fleet size under each set of conditions.
void list_scenes(const StudyOptions& options, StudyPlan& plan) {
  refuse_doubles("conditions", options.conditions);
  refuse_doubles("fleet size", fleet_sizes(options));
  std::vector<std::uint64_t> scene_seeds;
  if (options.scene_seeds) scene_seeds = parse_seeds(*options.scene_seeds, "--scene-seeds");
  for (const std::string& scenario : scenarios_of(options)) {
    for (const auto& scene_seed : each_or_none(scene_seeds)) {
      for (const auto& uavs : each_or_none(options.uavs)) {
        for (const auto& conditions : each_or_none(options.conditions)) {
          std::string name = scenario;
          if (scene_seed) name += " " + std::to_string(*scene_seed);
          if (uavs) name += " " + counted(*uavs, "UAV");
          if (conditions) name += " " + *conditions;
          plan.scenarios.push_back(name);
          plan.scenes.push_back({scenario, scene_seed ? scene_seed : options.scene_seed, uavs, conditions});
        }
      }
    }
  }
}

/// Names of scenarios by their files. @throws InputError if another name led to the file before
class ScenarioFiles {
 public:
  void add(const std::string& name, const fs::path& file) {
    const auto [before, is_new] = names_.emplace(fs::weakly_canonical(file), name);
    if (is_new || before->second == name) return;
    throw InputError("scenario '" + name + "' is named twice: '" + before->second + "' is the same file");
  }

 private:
  std::map<fs::path, std::string> names_;
};

RunOptions run_options(const StudyOptions& options, const StudyScene& scene, const std::string& planner) {
  RunOptions run;
  run.scenario = scene.scenario;
  run.planner = planner;
  run.scene_seed = scene.scene_seed;
  run.faults = options.faults;
  run.secure = options.secure;
  run.assets = options.assets;
  run.duration_s = options.duration_s;
  run.agent_timeout_s = options.agent_timeout_s;
  run.rules = options.rules;
  run.uavs = scene.uavs;
  run.conditions = scene.conditions;
  run.dds = options.dds.value_or(run.dds);
  run.agent = options.agent;
  run.network = options.network;
  run.record = options.record;
  return run;
}

/// Whether all planners of a fleet that name no agent are built into uav_agent. Then uav_agent flies them, and their
/// flights need not be repeated when the user's own agent is rebuilt.
bool are_all_built_in(const FleetPlan& plan, const std::vector<std::string>& built_in) {
  const auto is_built_in = [&](const UavPlanner& planner) {
    const std::string& spec = planner.spec;
    const bool is_listed = std::ranges::count(built_in, spec.substr(0, spec.find(':'))) > 0;
    return planner.agent || exec_command(spec) || python_spec(spec) || is_listed;
  };
  return std::ranges::all_of(plan.planners, is_built_in) && (!plan.ground || is_built_in(*plan.ground));
}

/// Lets the programs check a plan. @param with_server  also sim_server, which needs to check each scenario only once
void check_with_programs(const FleetPlan& plan, bool with_server) {
  const ScratchDir scratch;
  std::vector<ProgramSpec> programs = check_programs(plan, scratch.path());
  std::erase_if(programs,
                [&](const ProgramSpec& program) { return program.name == programs::kSimServer && !with_server; });
  try {
    run_checks(programs);
  } catch (const InputError& error) {
    throw InputError(plan.options.scenario + ", planner " + plan.options.planner + ": " + error.what());
  }
}

/// How the user calls this program: with the script of the source tree in which it was built, or as installed.
std::string own_command() {
  std::error_code error;
  const bool in_its_tree = fs::is_regular_file(program_dir() / "../../../skein", error);
  return in_its_tree ? "./skein" : "skein";
}

std::string command_line(const StudyPlan& plan) {
  const StudyOptions& options = plan.options;
  std::string line = own_command() + (options.contest ? " contest" : " compare");
  const auto add = [&](const std::string& option, const std::string& value) {
    line += " " + option + " " + shell_word(value);
  };
  for (const std::string& list : options.planner_lists) add("--planners", list);
  for (const std::string& planner : options.planners) add("--planner", planner);
  add("--scenarios", joined(scenarios_of(options), ","));
  if (options.contest) {
    add("--tests", std::to_string(plan.seeds.size()));
    if (options.rank != Rank::maximum) add("--rank", options.rank == Rank::median ? "median" : "worst");
  } else {
    add("--seeds", options.seeds);
  }
  if (options.scene_seed) add("--scene-seed", std::to_string(*options.scene_seed));
  if (options.scene_seeds) add("--scene-seeds", *options.scene_seeds);
  if (options.assets) add("--assets", *options.assets);
  if (options.duration_s) add("--duration", shortest(*options.duration_s));
  if (options.agent_timeout_s) add("--agent-timeout", shortest(*options.agent_timeout_s));
  if (options.rules) add("--rules", *options.rules);
  if (!options.uavs.empty()) add("--uavs", joined(fleet_sizes(options), ","));
  if (!options.conditions.empty()) add("--conditions", joined(options.conditions, ","));
  if (options.dds) add("--dds", *options.dds);
  if (const auto agent = own_agent(options.agent)) add("--agent", options.agent.value_or(*agent));
  if (options.faults) add("--faults", *options.faults);
  if (options.secure) line += " --secure";
  for (const std::string& requirement : options.requirements) add("--require", requirement);
  return line;
}

/// A value for a message, with texts unquoted.
std::string plain(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::vector<std::string> items;
  for (const Json& item : value) items.push_back(plain(item));
  return joined(items);
}

/// Names of the scenes' folders, not unique yet.
std::vector<std::string> stems_of(const StudyPlan& plan) {
  std::vector<std::string> stems;
  for (const StudyScene& scene : plan.scenes) {
    stems.push_back(fs::path(scene.scenario).stem());
    if (plan.options.scene_seeds) stems.back() += "-" + std::to_string(*scene.scene_seed);
    if (scene.uavs) stems.back() += "-uavs-" + std::to_string(*scene.uavs);
    if (scene.conditions) stems.back() += "-" + *scene.conditions;
  }
  return stems;
}

/// Settings in which a study must agree with the one in its folder to continue it. @param agents  digests by planner.
/// @param inputs  digests by scenario and planner
Json settings_of(const StudyPlan& plan, const std::string& programs, const Json& agents, const Json& inputs) {
  const StudyOptions& options = plan.options;
  return {{"command", options.contest ? "contest" : "compare"},
          {"skein_version", SKEIN_VERSION},
          {"planners", plan.planners},
          {"scenarios", plan.scenarios},
          {"seeds", plan.seeds},
          {"scene_seed", options.scene_seed ? Json(*options.scene_seed) : Json()},
          {"scene_seeds", options.scene_seeds ? Json(*options.scene_seeds) : Json()},
          {"faults", options.faults ? Json(options.faults->string()) : Json()},
          {"secure", options.secure},
          {"duration_s", options.duration_s ? Json(*options.duration_s) : Json()},
          {"agent_timeout_s", options.agent_timeout_s ? Json(*options.agent_timeout_s) : Json()},
          {"rules", options.rules ? Json(*options.rules) : Json()},
          {"uavs", options.uavs.empty() ? Json() : Json(options.uavs)},
          {"conditions", options.conditions.empty() ? Json() : Json(options.conditions)},
          {"dds", plan.medium},
          {"programs", programs},
          {"agents", agents},
          {"inputs", inputs}};
}

}  // namespace

std::vector<std::string> contest_scenarios(bool assets) {
  std::vector<std::string> scenarios = {"towers", "hangar", "cranes", "spire", "sail"};
  if (assets) scenarios.insert(scenarios.end(), {"mbs", "crane"});
  return scenarios;
}

Json StudyFlight::command() const {
  Json command = *made_under;
  command["seed"] = seed;
  return command;
}

StudyPlan plan_study(const StudyOptions& options, AskPrograms ask) {
  StudyPlan plan;
  plan.options = options;
  plan.planners = planners_of(options);
  plan.labels = planner_labels(plan.planners);
  list_scenes(options, plan);
  plan.seeds = parse_seeds(options.seeds);
  plan.out = fs::absolute(options.out.value_or(fs::path("runs") / (options.contest ? "contest" : "compare")));
  const std::vector<std::string> planner_folders = folder_names(plan.labels),
                                 scenario_folders = folder_names(stems_of(plan));

  std::string programs;
  std::set<std::string> media;
  std::vector<StudyFlight> of_one_seed;
  Json inputs = Json::object(), agents = Json::object();
  MadeUnder made_under;
  ScenarioFiles files;
  const Processes processes = options.dds ? Processes::as_given : Processes::one_if_possible;
  const auto built_in =
      own_agent(options.agent) ? planners_of(program_dir() / programs::kAgent) : std::vector<std::string>{};
  for (std::size_t s = 0; s < plan.scenarios.size(); ++s) {
    for (std::size_t p = 0; p < plan.planners.size(); ++p) {
      FleetPlan fleet = plan_fleet(run_options(options, plan.scenes[s], plan.planners[p]), program_dir(), processes);
      if (p == 0) files.add(plan.scenes[s].scenario, fleet.scenario.file);
      if (fleet.agent && are_all_built_in(fleet, built_in)) {
        fleet.options.agent = fleet.bin_dir / programs::kAgent;
        fleet = plan_fleet(fleet.options, fleet.bin_dir, processes);
      }
      media.insert(medium_of(fleet));
      // Scenes that differ only in scene seed or conditions are equally valid for a program.
      const bool another_seed = s > 0 && (options.scene_seeds || plan.scenes[s].conditions) &&
                                plan.scenes[s].scenario == plan.scenes[s - 1].scenario &&
                                plan.scenes[s].uavs == plan.scenes[s - 1].uavs;
      if (!another_seed && ask == AskPrograms::yes) check_with_programs(fleet, p == 0);
      const fs::path dir = plan.out / "flights" / scenario_folders[s] / planner_folders[p];
      const auto command = std::make_shared<const Json>(made_under.of(fleet));
      of_one_seed.push_back(
          {p, s, 0, dir, fleet.scenario.duration_s, fleet.options.agent, fleet.options.one_process, command});
      programs = command->at("programs");
      agents[plan.planners[p]] = command->at("agent");
      inputs[plan.scenarios[s] + ", " + plan.planners[p]] = command->at("input");
    }
  }
  const bool all_in_one = std::ranges::all_of(of_one_seed, &StudyFlight::one_process);
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  plan.jobs = options.jobs.value_or(all_in_one ? cores : 1);
  plan.medium = joined({media.begin(), media.end()});
  for (const std::uint64_t seed : plan.seeds) {
    for (StudyFlight flight : of_one_seed) {
      flight.seed = seed;
      flight.dir /= "seed-" + std::to_string(seed);
      plan.flights.push_back(std::move(flight));
    }
  }
  plan.settings = settings_of(plan, programs, agents, inputs);
  plan.command_line = command_line(plan);
  return plan;
}

std::vector<std::string> differing_settings(const Json& then, const Json& now) {
  std::vector<std::string> differences;
  for (const auto& [key, value] : now.items()) {
    const Json former = value_or(then, key.c_str(), nullptr);
    if (former == value || key == "inputs") continue;
    if (key == "agents") {
      std::vector<std::string> planners;
      for (const auto& [planner, digest] : value.items()) {
        if (former.is_object() && former.contains(planner) && former[planner] != digest) planners.push_back(planner);
      }
      if (!planners.empty()) differences.push_back("the agent program was built anew that flies " + joined(planners));
    } else if (key == "programs") {
      differences.push_back("the programs were built anew");
    } else {
      differences.push_back(key + ": then " + plain(former) + ", now " + plain(value));
    }
  }
  // For flights of both studies: a file has changed, unless an option that is listed above explains the difference.
  const Json former = value_or(then, "inputs", Json::object()), inputs = value_or(now, "inputs", Json::object());
  std::vector<std::string> changed;
  for (const auto& [flight, input] : inputs.items()) {
    if (former.contains(flight) && former[flight] != input) changed.push_back(flight);
  }
  if (!changed.empty() && differences.empty()) {
    differences.push_back("files of scenario, vehicles, scene or parameters are not the same for " +
                          joined(changed, "; "));
  }
  return differences;
}

std::string repeating_command(const StudyPlan& plan, const StudyFlight& flight) {
  const StudyScene& scene = plan.scenes[flight.scenario];
  std::string line = own_command() + " run " + shell_word(scene.scenario);
  const auto add = [&](const std::string& option, const std::string& value) {
    line += " " + option + " " + shell_word(value);
  };
  if (scene.scene_seed) add("--scene-seed", std::to_string(*scene.scene_seed));
  add("--planner", plan.planners[flight.planner]);
  if (flight.seed != 0) add("--seed", std::to_string(flight.seed));
  if (plan.options.duration_s) add("--duration", shortest(*plan.options.duration_s));
  if (plan.options.agent_timeout_s) add("--agent-timeout", shortest(*plan.options.agent_timeout_s));
  if (plan.options.rules) add("--rules", *plan.options.rules);
  if (scene.uavs) add("--uavs", std::to_string(*scene.uavs));
  if (scene.conditions) add("--conditions", *scene.conditions);
  if (plan.options.assets) add("--assets", *plan.options.assets);
  if (flight.agent) {
    add("--agent", *flight.agent);
  } else if (const auto agent = own_agent({})) {
    add("--agent", *agent);
  }
  if (plan.options.faults) add("--faults", *plan.options.faults);
  if (plan.options.secure) line += " --secure";
  if (flight.one_process) line += " --one-process";
  return line;
}

RunOptions flight_options(const StudyPlan& plan, const StudyFlight& flight) {
  RunOptions run = run_options(plan.options, plan.scenes[flight.scenario], plan.planners[flight.planner]);
  run.seed = flight.seed;
  run.agent = flight.agent;
  run.one_process = flight.one_process;
  run.out = flight.dir;
  run.force = true;
  return run;
}

}  // namespace skein::cli
