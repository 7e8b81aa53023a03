#include "run/agent_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>

#include "core/planners/python_spec.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/host/environment.hpp"
#include "process/reports/reports.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kTailLines = 5;
/// Far longer than any agent needs to list its planners, also on a busy machine.
constexpr std::chrono::seconds kListTime{30};

struct Answer {
  bool in_time = true;
  std::optional<StrategyList> list = {};  ///< nullopt: the program's output is not a list
};

/// Has an agent program list its strategies. @param said  file for its output
Answer answer_of(const std::filesystem::path& agent, const std::filesystem::path& said) {
  if (!std::filesystem::exists(agent)) return {};
  if (!run_within({programs::kAgent, {agent, "--list-planners"}, fleet_environment(false), said}, kListTime)) {
    return {.in_time = false};
  }
  const Json list = read_json(said);
  return {.list = list.is_object() ? std::optional(struct_of<StrategyList>(list)) : std::nullopt};
}

StrategyList strategies_of(const std::filesystem::path& agent) {
  const ScratchDir scratch;
  return answer_of(agent, scratch.path() / "said").list.value_or(StrategyList{});
}

std::filesystem::path stock_agent() { return program_dir() / programs::kAgent; }

/// @param option  the option that named the file. @param hint  ends the error message if there is no such file.
/// @returns its absolute path.
std::filesystem::path checked_agent(const std::filesystem::path& named, const std::string& option,
                                    const std::string& hint = "") {
  const std::filesystem::path agent = std::filesystem::absolute(named).lexically_normal();
  const std::string what = option + ": " + agent.string();
  if (!std::filesystem::is_regular_file(agent)) throw InputError(what + ": there is no such file" + hint);
  if (::access(agent.c_str(), X_OK) != 0) throw InputError(what + ": this file cannot be executed");
  if (std::error_code none; std::filesystem::equivalent(agent, stock_agent(), none)) return stock_agent();
  const ScratchDir scratch;
  const Answer answer = answer_of(agent, scratch.path() / "said");
  if (answer.list) return agent;
  const std::string wrong =
      answer.in_time ? "does not list its planners" : "did not end within " + std::to_string(kListTime.count()) + " s";
  throw InputError(what + ": --list-planners " + wrong + "; skein_add_agent() makes agent programs " +
                   "(docs/how-to-add-a-planner.md), and a program of another kind flies with --planner exec:CMD" +
                   last_lines_below(scratch.path() / "said", kTailLines));
}

/// Ends the error message about a missing agent program: the last '@' may have been meant as part of a parameter.
std::string hint_for(const UavPlanner& planner) {
  if (!has_parameters(planner.spec)) return "";
  return "; what follows the last '@' is an agent program, without commas: where a '@' belongs to a parameter, write " +
         written(planner) + "@" + stock_agent().string();
}

/// @throws InputError if an agent program has no such planner. (The agent's own message would not name the program.)
void require_known(const UavPlanner& planner, const std::vector<std::string>& known) {
  if (python_spec(planner.spec)) return;  // every agent can load Python
  const std::string name = planner.spec.substr(0, planner.spec.find(':'));
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError("--planner " + shortened(written(planner)) + ": there is no planner '" + shortened(name) +
                   "' in it; " + suggestion(name, known));
}

}  // namespace

std::optional<std::filesystem::path> own_agent(const std::optional<std::filesystem::path>& chosen) {
  const char* variable = std::getenv("SKEIN_AGENT");
  const bool by_variable = !chosen && variable != nullptr && *variable != '\0';
  if (!chosen && !by_variable) return std::nullopt;
  const auto agent = checked_agent(by_variable ? variable : *chosen, by_variable ? "SKEIN_AGENT" : "--agent");
  return agent == stock_agent() ? std::nullopt : std::optional(agent);
}

void find_agents(Planners& planners, const std::optional<std::filesystem::path>& own) {
  std::map<std::filesystem::path, std::filesystem::path> found;
  std::map<std::filesystem::path, StrategyList> strategies;
  const auto find = [&](UavPlanner& planner) {
    if (!planner.agent) return;
    const auto [program, is_new] = found.try_emplace(*planner.agent);
    if (is_new) program->second = checked_agent(*planner.agent, "--planner " + written(planner), hint_for(planner));
    planner.agent = program->second;
    const bool needs_none = planner.spec.find('@') == std::string::npos;  // else the spec needs its AGENT
    if (!own && planner.agent == stock_agent() && needs_none) planner.agent.reset();
  };
  const auto find_for_uav = [&](UavPlanner& planner) {
    find(planner);
    if (!planner.agent || planner.agent == stock_agent()) return;
    const auto [list, is_new] = strategies.try_emplace(*planner.agent);
    if (is_new) list->second = strategies_of(*planner.agent);
    require_known(planner, list->second.planners);
  };
  find(planners.fallback);
  for (UavPlanner& planner : planners.uavs) find_for_uav(planner);
  if (planners.ground) find(*planners.ground);
}

std::vector<std::string> planners_of(const std::filesystem::path& agent) { return strategies_of(agent).planners; }

std::vector<std::string> ground_programs_of(const std::filesystem::path& agent) {
  return strategies_of(agent).ground_programs;
}

}  // namespace skein::cli
