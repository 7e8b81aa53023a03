#include "run/debug_plan.hpp"

#include <algorithm>

#include "core/planners/python_spec.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

/// The program for a name that the user gives with an option: of a UAV, "gcs", or a server.
std::string debugged_program(const FleetPlan& plan, const std::string& option, const std::string& name) try {
  const auto& servers = programs::kServers;
  if (std::find(servers.begin(), servers.end(), name) != servers.end()) return name;
  const std::string program = programs::agent_program(name);
  if (program == programs::kGroundAgent && plan.ground) return program;
  plan.scenario.uav_index(name);  // throws for an unknown name
  return program;
} catch (const InputError& error) {
  throw InputError(option + ": " + error.what());
}

}  // namespace

std::vector<Debuggee> debuggees(const FleetPlan& plan) {
  const auto program_of = [&](const std::string& name) { return debugged_program(plan, "--debug", name); };
  std::vector<Debuggee> all = parse_debug(plan.options.debug, program_of);
  for (const Debuggee& one : all) {
    const std::string why = "--debug " + one.member;
    if (plan.options.secure && one.how != Debuggee::How::by_hand) {
      throw InputError(why +
                       ": with --secure, leave out =TOOL, and start the debugger with the command that Skein prints");
    }
    if (plan.options.break_at_s && one.program == programs::kSimServer) {
      throw InputError(
          "--break-at: sim_server advances the time itself, so it cannot stop at a time; set a breakpoint in its code");
    }
    const bool in_python = programs::is_agent(one.program) && one.program != programs::kGroundAgent &&
                           python_spec(planner_of(plan, one.program).spec).has_value();
    if (one.how == Debuggee::How::pdb && !in_python) {
      throw InputError(why + "=pdb: only a planner in Python (--planner py:FILE) has pdb; gdb is for all others");
    }
    if (one.how == Debuggee::How::wait && is_exec(plan, one.program)) {
      throw InputError(why + "=wait: a command of yours (exec:) cannot wait for a debugger; use gdb or gdbserver:PORT");
    }
  }
  return all;
}

std::map<std::string, std::string> log_levels(const FleetPlan& plan) {
  const std::vector<std::string> known = {"trace", "debug", "info", "warn", "error", "off"};
  std::map<std::string, std::string> levels;
  for (const std::string& value : plan.options.log) {
    const std::size_t cut = value.find('=');
    const std::string program = debugged_program(plan, "--log", value.substr(0, cut));
    const std::string level = cut == std::string::npos ? "" : value.substr(cut + 1);
    if (std::ranges::find(known, level) == known.end()) {
      throw InputError("--log " + value + ": '" + level + "' is not a level; " + suggestion(level, known));
    }
    if (is_exec(plan, program))
      throw InputError("--log " + value +
                       ": a command of yours (exec:) has no such level, because it writes its own log");
    if (!levels.emplace(program, level).second) {
      throw InputError("--log " + value + ": " + value.substr(0, cut) + " is named twice");
    }
  }
  return levels;
}

}  // namespace skein::cli
