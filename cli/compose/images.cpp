#include "cli/compose/images.hpp"

#include "core/planners/python_spec.hpp"

namespace skein::cli {

ProgramImage image_of(const FleetPlan& plan, const std::string& program) {
  if (!programs::is_agent(program)) return {"skein", "SKEIN_IMAGE"};
  if (python_spec(planner_of(plan, program).spec)) return {"skein-agent-python", "SKEIN_PYTHON_AGENT_IMAGE"};
  return {"skein-agent", "SKEIN_AGENT_IMAGE"};
}

}  // namespace skein::cli
