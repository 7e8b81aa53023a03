#include "run/fleet_programs.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "core/config/config_files.hpp"
#include "core/planners/free_nodes.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/environment.hpp"
#include "host/threads.hpp"
#include "results/run_folder.hpp"
#include "run/debug_plan.hpp"
#include "run/exec_variables.hpp"
#include "run/free_nodes.hpp"
#include "run/watch_arguments.hpp"

namespace skein::cli {
namespace {

using Arguments = std::vector<std::string>;

void append(Arguments& arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
}

/// The lease after which DDS considers a silent program gone [s]. It is longer than the timeout for a silent program,
/// also at startup: a program that is stopped for a while must not count as dead when it continues. The launcher
/// detects dead programs without leases.
int lease_s(const FleetPlan& plan) {
  if (plan.options.lease_s) return *plan.options.lease_s;
  if (!plan.debug.empty()) return kLongestLease_s;
  constexpr double kUsualTimeout_s = 60.0, kTimes = 3.0;
  const double timeout_s = std::max(plan.options.agent_timeout_s.value_or(kUsualTimeout_s), kUsualTimeout_s);
  return static_cast<int>(std::min(kTimes * timeout_s, static_cast<double>(kLongestLease_s)));
}

/// Arguments with which all programs read the same scenario.
Arguments scenario_arguments(const FleetPlan& plan) {
  const RunOptions& options = plan.options;
  Arguments arguments = {"--scenario", std::filesystem::absolute(plan.scenario.file), "--seed",
                         std::to_string(options.seed)};
  if (options.assets) append(arguments, {"--assets", std::filesystem::absolute(*options.assets)});
  if (options.scene_seed) append(arguments, {"--scene-seed", std::to_string(*options.scene_seed)});
  if (options.uavs) append(arguments, {"--uavs", std::to_string(*options.uavs)});
  if (options.duration_s) append(arguments, {"--duration", shortest(*options.duration_s)});
  if (options.rules) append(arguments, {"--rules", *options.rules});
  if (options.conditions) append(arguments, {"--conditions", *options.conditions});
  if (options.faults) append(arguments, {"--faults", std::filesystem::absolute(*options.faults)});
  return arguments;
}

Arguments command_line(const FleetPlan& plan, const std::filesystem::path& binary) {
  Arguments arguments = {binary};
  append(arguments, scenario_arguments(plan));
  if (plan.options.network) append(arguments, {"--network", *plan.options.network});
  return arguments;
}

/// Whether a program is an agent other than Skein's own uav_agent.
bool is_foreign(const FleetPlan& plan, const std::string& program) {
  return programs::is_agent(program) && agent_file(plan, program) != plan.bin_dir / programs::kAgent;
}

/// Variables for agents from elsewhere and users' commands (skein.client): beside their own binaries, these do not find
/// Skein's configuration and programs.
std::map<std::string, std::string> config_variable(const FleetPlan& plan, const std::string& program) {
  if (!is_foreign(plan, program) && !is_exec(plan, program)) return {};
  return {{"SKEIN_CONFIG_DIR", std::filesystem::absolute(default_config_dir())},
          {"SKEIN_BIN_DIR", std::filesystem::absolute(plan.bin_dir)}};
}

bool has_ground_program(const FleetPlan& plan) { return plan.ground && takes_part(plan, "gcs"); }

Arguments replay_arguments(const ReplayOf& replay) {
  Arguments arguments = {"--replay", replay.recording};
  if (replay.until_s) append(arguments, {"--replay-until", shortest(*replay.until_s)});
  if (!replay.only.empty()) append(arguments, {"--replay-only", joined(replay.only, ",")});
  if (!replay.other.empty()) append(arguments, {"--replay-other", joined(replay.other, ",")});
  return arguments;
}

/// Arguments for an agent's UAV (or the ground station) and planner.
Arguments role_arguments(const FleetPlan& plan, const std::string& program) {
  const auto& maps_s = plan.options.keep_maps_s;
  const std::string& planner = planner_of(plan, program).spec;
  if (program == programs::kGroundAgent) return {"--role", "gcs", "--planner", planner};
  Arguments arguments = {"--uav", programs::member_name(program)};
  if (planner != kFreeNodes) {  // an agent without a planner refuses these
    if (maps_s) append(arguments, {"--maps-every", shortest(*maps_s)});
    if (plan.options.time_parts) append(arguments, {"--time-parts"});
  }
  append(arguments, {"--planner", planner});
  return arguments;
}

/// @param program  name of a server or an agent
Arguments run_arguments(const FleetPlan& plan, const std::string& program, int base_domain,
                        const std::filesystem::path& out, const SecureFolder& secure) {
  Arguments arguments = {program_file(plan, program)};
  append(arguments, program_arguments(plan, program, base_domain));
  if (plan.options.network) append(arguments, {"--network", *plan.options.network});
  append(arguments, {"--out", secure.out.empty() ? out : secure.out});
  if (!secure.keys.empty()) append(arguments, {"--security", secure.keys});
  const auto level = plan.log_levels.find(program);
  if (level != plan.log_levels.end()) append(arguments, {"--log-level", level->second});
  const auto debugged = std::ranges::find(plan.debug, program, &Debuggee::program);
  if (debugged != plan.debug.end() && debugged->how == Debuggee::How::pdb) {
    append(arguments, {"--pdb", shortest(plan.options.break_at_s.value_or(0.0))});
  } else if (debugged != plan.debug.end() && plan.options.break_at_s) {
    append(arguments, {"--break-at", shortest(*plan.options.break_at_s)});
  }
  append(arguments, {"--lease", std::to_string(lease_s(plan)), "--run", std::to_string(plan.run)});
  return arguments;
}

SecureFolder secure_folder(const SecureFolders& secure, const std::string& program) {
  const auto found = secure.find(program);
  return found == secure.end() ? SecureFolder{} : found->second;
}

}  // namespace

std::vector<std::string> program_arguments(const FleetPlan& plan, const std::string& program, int base_domain) {
  Arguments arguments = scenario_arguments(plan);
  append(arguments, {"--dds", dds_vendors(plan).at(program), "--domain", std::to_string(base_domain)});
  if (programs::is_agent(program)) append(arguments, role_arguments(plan, program));
  if (!programs::is_agent(program)) append(arguments, {"--record", plan.options.record});
  const std::string stand_ins = joined(uavs_of_free_nodes(plan.planners), ",");
  const bool hears_nodes = program == programs::kSimServer || program == programs::kCommRouter;
  if (hears_nodes && !stand_ins.empty()) append(arguments, {"--stand-ins", stand_ins});
  const bool replays = program == programs::kSimServer || program == programs::kCommRouter;
  if (replays && plan.options.replay) append(arguments, replay_arguments(*plan.options.replay));
  if (program == programs::kSimServer) {
    append(arguments, {"--clock", plan.options.clock});
    if (plan.options.stop_at_s) append(arguments, {"--stop-at", shortest(*plan.options.stop_at_s)});
    if (!plan.debug.empty()) append(arguments, {"--agent-timeout", "0"});
    if (plan.options.agent_timeout_s) append(arguments, {"--agent-timeout", shortest(*plan.options.agent_timeout_s)});
    if (has_ground_program(plan)) arguments.push_back("--ground-program");
    if (plan.watched) append(arguments, watch_arguments(plan));
  }
  return arguments;
}

std::vector<ProgramSpec> fleet_programs(const FleetPlan& plan, int base_domain, const std::filesystem::path& out,
                                        const SecureFolders& secure) {
  std::vector<ProgramSpec> programs;
  const auto add = [&](const std::string& name) {
    const SecureFolder own = secure_folder(secure, name);
    if (is_exec(plan, name)) {
      programs.push_back({name,
                          {"/bin/sh", "-c", *exec_command(planner_of(plan, name).spec)},
                          fleet_environment(plan.options.native, exec_variables(plan, name, base_domain, out, own)),
                          out / run_folder::log_file(name)});
      return;
    }
    Arguments arguments = run_arguments(plan, name, base_domain, out, own);
    append(arguments, {"--status-fd", std::to_string(kStatusFd), "--control-fd", std::to_string(kControlFd)});
    if (plan.watched && name == programs::kStation) append(arguments, view_arguments(plan));
    programs.push_back({name, std::move(arguments), fleet_environment(plan.options.native, config_variable(plan, name)),
                        out / run_folder::log_file(name)});
  };
  for (const char* name : programs::kServers) add(name);
  for (const UavConfig& uav : plan.scenario.fleet) {
    if (takes_part(plan, uav.name)) add(programs::agent_program(uav.name));
  }
  if (has_ground_program(plan)) add(programs::kGroundAgent);
  for (const Debuggee& debuggee : plan.debug) {
    if (debuggee.how == Debuggee::How::by_hand) {
      std::erase_if(programs, [&](const ProgramSpec& program) { return program.name == debuggee.program; });
    }
  }
  for (ProgramSpec& program : programs) {
    // The servers are Skein's own, and write status lines as long as the run lasts.
    if (!programs::is_agent(program.name)) program.most_status_bytes = std::numeric_limits<std::uint64_t>::max();
    if (plan.watched && program.name == programs::kStation) program.listener = plan.watched->listener;
    program.user = secure_folder(secure, program.name).user;
    program.minded = is_foreign(plan, program.name) || is_exec(plan, program.name);  // not Skein's own
    for (const Debuggee& debuggee : plan.debug) {
      if (debuggee.program == program.name) put_under_tool(program, debuggee);
    }
  }
  return programs;
}

ProgramSpec shared_process(const FleetPlan& plan, const std::filesystem::path& out) {
  const std::string agent = programs::agent_program(plan.scenario.fleet.front().name);  // all agents use this program
  ProgramSpec process{
      programs::kOneProcess,
      {fleet_file(plan), "--status-fd", std::to_string(kStatusFd), "--control-fd", std::to_string(kControlFd)},
      fleet_environment(plan.options.native, config_variable(plan, agent)),
      out / run_folder::log_file(programs::kOneProcess)};
  if (plan.options.agent_timeout_s) append(process.argv, {"--agent-timeout", shortest(*plan.options.agent_timeout_s)});
  append(process.argv, {"--threads", std::to_string(threads_of(plan.options.threads, plan.scenario.fleet.size()))});
  process.most_status_bytes = std::numeric_limits<std::uint64_t>::max();
  process.minded = is_foreign(plan, agent);
  if (plan.watched) process.listener = plan.watched->listener;
  return process;
}

std::filesystem::path program_file(const FleetPlan& plan, const std::string& program) {
  if (is_exec(plan, program)) return "/bin/sh";
  return programs::is_agent(program) ? agent_file(plan, program) : plan.bin_dir / program;
}

std::string debug_command(const FleetPlan& plan, const std::string& program, int base_domain,
                          const std::filesystem::path& out, const SecureFolders& secure) {
  SecureFolder own = secure_folder(secure, program);
  if (own.user) own.out.clear();  // the user who types the command may write to the results folder
  own.user.reset();
  std::string command = fleet_environment_prefix(plan.options.native);
  if (is_exec(plan, program)) {
    for (const auto& [name, value] : exec_variables(plan, program, base_domain, out, own)) {
      command += name + "=" + shell_word(value) + " ";
    }
    return command + "/bin/sh -c " + shell_word(*exec_command(planner_of(plan, program).spec));
  }
  for (const auto& [name, value] : config_variable(plan, program)) command += name + "=" + shell_word(value) + " ";
  return command + "gdb --args " + shell_line(run_arguments(plan, program, base_domain, out, own));
}

std::vector<ProgramSpec> check_programs(const FleetPlan& plan, const std::filesystem::path& scratch,
                                        const std::optional<UserId>& agent_user) {
  std::vector<ProgramSpec> programs;
  const auto add = [&](const std::string& name, Arguments arguments) {
    arguments.push_back("--check");
    programs.push_back({name, std::move(arguments), fleet_environment(plan.options.native, config_variable(plan, name)),
                        scratch / run_folder::log_file(name)});
    if (programs::is_agent(name)) programs.back().user = agent_user;
  };
  const auto add_agent = [&](const std::string& name) {
    Arguments arguments = command_line(plan, agent_file(plan, name));
    append(arguments, role_arguments(plan, name));
    add(name, std::move(arguments));
  };
  add(programs::kSimServer, command_line(plan, plan.bin_dir / programs::kSimServer));
  std::set<std::string> checked;
  for (const UavPlanner& planner : plan.planners) {
    if (exec_command(planner.spec) || !checked.insert(written(planner)).second) continue;
    add_agent(programs::agent_program(planner.uav));
  }
  if (plan.ground && !exec_command(plan.ground->spec)) add_agent(programs::kGroundAgent);
  return programs;
}

}  // namespace skein::cli
