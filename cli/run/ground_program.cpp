#include "cli/run/ground_program.hpp"

#include <algorithm>

#include "cli/run/agent_file.hpp"

namespace skein::cli {

std::optional<std::string> ground_program(const Planners& planners, const std::filesystem::path& agent) {
  if (planners.ground) return *planners.ground == "none" ? std::nullopt : planners.ground;
  if (exec_command(planners.fallback)) return std::nullopt;
  const std::string name = planners.fallback.substr(0, planners.fallback.find(':'));
  // An agent that is missing is complained about where it is needed.
  const auto listed = ground_programs_of(agent);
  const bool has_one = std::find(listed.begin(), listed.end(), name) != listed.end();
  return has_one ? std::optional(planners.fallback) : std::nullopt;
}

}  // namespace skein::cli
