#include "run/ground_agent.hpp"

#include <algorithm>

#include "run/agent_file.hpp"

namespace skein::cli {

std::optional<UavPlanner> ground_program(const Planners& planners, const std::filesystem::path& agent) {
  if (planners.ground) return planners.ground->spec == kNoGround ? std::nullopt : planners.ground;
  const UavPlanner& planner = planners.fallback;
  if (exec_command(planner.spec)) return std::nullopt;
  const std::string name = planner.spec.substr(0, planner.spec.find(':'));
  // For a missing agent program, the list is empty: the code that needs the program reports the error.
  const auto listed = ground_programs_of(planner.agent.value_or(agent));
  const bool has_one = std::find(listed.begin(), listed.end(), name) != listed.end();
  return has_one ? std::optional(planner) : std::nullopt;
}

}  // namespace skein::cli
