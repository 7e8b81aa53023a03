#include "cli/run/agent_file.hpp"

#include <unistd.h>

#include <cstdlib>

#include "cli/run/environment.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/preflight.hpp"
#include "cli/run/supervisor.hpp"
#include "process/reports.hpp"
#include "process/run_folder.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kTailLines = 5;

/// Has an agent program list its strategies. @param said  file for what it prints. @returns nullopt if that is no list.
std::optional<StrategyList> strategies_of(const std::filesystem::path& agent, const std::filesystem::path& said) {
  if (!std::filesystem::exists(agent)) return std::nullopt;
  run_to_end({programs::kAgent, {agent, "--list-planners"}, fleet_environment(false), said});
  const Json list = read_json(said);
  return list.is_object() ? std::optional(struct_of<StrategyList>(list)) : std::nullopt;
}

StrategyList strategies_of(const std::filesystem::path& agent) {
  const ScratchDir scratch;
  return strategies_of(agent, scratch.path() / "said").value_or(StrategyList{});
}

}  // namespace

std::optional<std::filesystem::path> own_agent(const std::optional<std::filesystem::path>& chosen) {
  const char* variable = std::getenv("SKEIN_AGENT");
  const bool by_variable = !chosen && variable != nullptr && *variable != '\0';
  if (!chosen && !by_variable) return std::nullopt;
  const std::filesystem::path agent = std::filesystem::absolute(by_variable ? variable : *chosen).lexically_normal();
  const std::string what = (by_variable ? "SKEIN_AGENT: " : "--agent: ") + agent.string();
  if (!std::filesystem::is_regular_file(agent)) throw InputError(what + ": there is no such file");
  if (::access(agent.c_str(), X_OK) != 0) throw InputError(what + ": this file cannot be executed");
  if (std::error_code none; std::filesystem::equivalent(agent, program_dir() / programs::kAgent, none))
    return std::nullopt;
  const ScratchDir scratch;
  if (strategies_of(agent, scratch.path() / "said")) return agent;
  std::string message = what + ": --list-planners does not list its planners; skein_add_agent() makes agent programs " +
                        "(docs/how-to-add-a-planner.md), and a program of another kind flies with --planner exec:CMD";
  for (const std::string& line : last_lines(scratch.path() / "said", kTailLines)) message += "\n    " + line;
  throw InputError(message);
}

std::vector<std::string> planners_of(const std::filesystem::path& agent) { return strategies_of(agent).planners; }

std::vector<std::string> ground_programs_of(const std::filesystem::path& agent) {
  return strategies_of(agent).ground_programs;
}

}  // namespace skein::cli
