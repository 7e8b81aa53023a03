#include "run/fleet_plan.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

#include "core/config/network_config.hpp"
#include "core/planners/free_nodes.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/topics.hpp"
#include "host/domain_block.hpp"
#include "host/environment.hpp"
#include "host/threads.hpp"
#include "results/run_folder.hpp"
#include "run/agent_file.hpp"
#include "run/debug_plan.hpp"
#include "run/drawn_world.hpp"
#include "run/exec_variables.hpp"
#include "run/free_nodes.hpp"
#include "run/ground_agent.hpp"
#include "run/hand_flights.hpp"
#include "run/python_planners.hpp"

namespace skein::cli {
namespace {

constexpr std::array<const char*, 2> kVendors = {"cyclonedds", "fastdds"};

std::filesystem::path fleets_agent(const FleetPlan& plan) {
  return plan.agent.value_or(plan.bin_dir / programs::kAgent);
}

void choose_processes(FleetPlan& plan, Processes processes) {
  RunOptions& options = plan.options;
  const std::size_t uavs = plan.scenario.fleet.size();
  const bool is_too_large = processes == Processes::one_if_large && uavs > kMostUavsOverDds && !options.one_process;
  const bool either = processes == Processes::one_if_possible || is_too_large;
  const auto reason = either || options.one_process ? needs_processes(plan) : std::nullopt;
  if (is_too_large && reason) {
    throw InputError("a fleet of " + std::to_string(uavs) + " UAVs must fly in one process, because over DDS at most " +
                     std::to_string(kMostUavsOverDds) + " can; but " + *reason);
  }
  if (either) {
    options.one_process = !reason;
  } else if (reason) {
    throw InputError(*reason + "; leave out --one-process");
  }
  if (!options.one_process) return check_uavs_over_dds(uavs);
  // Read now, because SKEIN_THREADS may be wrong, and later the results folder has been emptied already.
  options.threads = threads_of(options.threads, uavs);
}

/// @throws InputError for --keep-maps of a fleet in which nothing keeps maps
void check_keep_maps(const FleetPlan& plan) {
  const auto keeps_none = [](const UavPlanner& p) { return exec_command(p.spec) || p.spec == kFreeNodes; };
  if (!plan.options.keep_maps_s || !std::ranges::all_of(plan.planners, keeps_none)) return;
  throw InputError("--keep-maps: programs of your own fly all UAVs, and they keep no maps");
}

}  // namespace

LoadOptions load_options(const RunOptions& options) {
  LoadOptions load;
  load.assets_dir = options.assets.value_or("");
  load.duration_s = options.duration_s;
  load.scene_seed = options.scene_seed;
  load.uavs = options.uavs;
  load.rules = options.rules;
  load.conditions = options.conditions;
  return load;
}

FleetPlan plan_fleet(const RunOptions& options, const std::filesystem::path& bin_dir, Processes processes) {
  check_environment();
  if (options.secure && options.dds == "mixed") {
    throw InputError(
        "--secure --dds mixed: the vendors' security does not work together reliably; choose cyclonedds or fastdds");
  }
  FleetPlan plan{options, scenario_flown(options), {}, bin_dir, {}};
  plan.faults = load_fault_plan(options.faults.value_or(""), plan.scenario, options.seed);
  Planners planners = parse_planners(options.planner, plan.scenario.uav_names());
  check_hands(planners.uavs, options.view.at.has_value(), options.stepped);
  plan.agent = own_agent(options.agent);
  find_python_files(planners);
  find_agents(planners, plan.agent);
  plan.planners = planners.uavs;
  check_exec(plan);
  check_free_nodes(plan.planners, options.clock);
  check_keep_maps(plan);
  plan.ground = ground_program(planners, fleets_agent(plan));
  if (options.network) read_network(*options.network).check_names(domain_names(plan.scenario));
  for (const std::string& uav : options.replay ? options.replay->only : std::vector<std::string>()) {
    if (uav != "gcs") plan.scenario.uav_index(uav);
    // Otherwise no program would run, and none would differ from the recorded one.
    if (uav == "gcs" && !plan.ground) throw InputError("gcs: this fleet has no program at the ground station");
  }
  plan.debug = debuggees(plan);
  plan.log_levels = log_levels(plan);
  choose_processes(plan, processes);
  return plan;
}

std::uint64_t draw_run_id() {
  std::random_device device;
  std::uint64_t run = 0;
  while (run == 0) run = (std::uint64_t{device()} << 32) | device();
  return run;
}

const UavPlanner& planner_of(const FleetPlan& plan, const std::string& program) {
  if (program == programs::kGroundAgent) return *plan.ground;
  return plan.planners[plan.scenario.uav_index(programs::member_name(program))];
}

std::filesystem::path agent_file(const FleetPlan& plan, const std::string& program) {
  return planner_of(plan, program).agent.value_or(fleets_agent(plan));
}

std::vector<std::filesystem::path> agent_files(const FleetPlan& plan) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::string& program) {
    const std::filesystem::path file = agent_file(plan, program);
    if (!is_exec(plan, program) && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  for (const UavPlanner& planner : plan.planners) add(programs::agent_program(planner.uav));
  if (plan.ground) add(programs::kGroundAgent);
  if (files.empty()) files.push_back(fleets_agent(plan));
  return files;
}

std::filesystem::path fleet_file(const FleetPlan& plan) { return agent_files(plan).front() += programs::kFleetSuffix; }

std::optional<std::string> needs_processes(const FleetPlan& plan) {
  std::vector<UavPlanner> all = plan.planners;
  if (plan.ground) all.push_back(*plan.ground);
  for (const UavPlanner& planner : all) {
    if (exec_command(planner.spec)) {
      return "--planner " + planner.uav + "=" + planner.spec + " needs processes: it is a program of its own";
    }
    if (planner.spec == kFreeNodes) return "--planner " + planner.uav + "=ros needs processes: ROS 2 nodes speak DDS";
  }
  if (plan.options.network) return "--network needs processes: other hosts take part over DDS";
  if (plan.options.secure)
    return "--secure needs processes: it keeps programs apart that cannot see each other's memory";
  const std::vector<std::filesystem::path> files = agent_files(plan);
  if (files.size() > 1) {
    return "--planner " + plan.options.planner + " needs processes: " + files[0].string() + " and " +
           files[1].string() + " are two programs";
  }
  if (!std::filesystem::exists(fleet_file(plan))) {
    return "there is no " + fleet_file(plan).string() +
           ", in which such a fleet could fly as one process (skein_add_agent() builds it beside the agent)";
  }
  return std::nullopt;
}

std::filesystem::path program_dir() {
  const char* chosen = std::getenv("SKEIN_BIN_DIR");
  if (chosen != nullptr && *chosen != '\0') return chosen;
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

int domain_count(const FleetPlan& plan) { return 2 + static_cast<int>(plan.scenario.fleet.size()); }

int agent_domain(const FleetPlan& plan, const std::string& program, int base_domain) {
  if (program == programs::kGroundAgent) return gcs_domain(base_domain);
  return uav_domain(base_domain, plan.scenario.uav_index(programs::member_name(program)));
}

std::map<std::string, std::string> dds_vendors(const FleetPlan& plan) {
  std::vector<std::string> names(programs::kServers.begin(), programs::kServers.end());
  for (const UavConfig& uav : plan.scenario.fleet) names.push_back(programs::agent_program(uav.name));
  if (plan.ground) names.push_back(programs::kGroundAgent);
  std::map<std::string, std::string> vendors;
  for (std::size_t i = 0; i < names.size(); ++i) {
    vendors[names[i]] = plan.options.one_process      ? "inproc"
                        : plan.options.dds == "mixed" ? kVendors[i % kVendors.size()]
                                                      : plan.options.dds;
  }
  return vendors;
}

bool takes_part(const FleetPlan& plan, const std::string& member) {
  if (!plan.options.replay || plan.options.replay->only.empty()) return true;
  return std::ranges::find(plan.options.replay->only, member) != plan.options.replay->only.end();
}

bool is_exec(const FleetPlan& plan, const std::string& program) {
  return programs::is_agent(program) && exec_command(planner_of(plan, program).spec).has_value();
}

}  // namespace skein::cli
