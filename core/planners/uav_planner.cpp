#include "core/planners/uav_planner.hpp"

namespace skein {

std::string written(const UavPlanner& planner) {
  return planner.agent ? planner.spec + '@' + planner.agent->string() : planner.spec;
}

bool is_command(std::string_view spec) { return spec.starts_with(kExec) || spec.starts_with(kRos); }

}  // namespace skein
