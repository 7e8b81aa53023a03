#include "uav_agent/api/planner.hpp"

namespace skein::agent {

std::vector<std::string> planner_names() { return StrategyRegistry<Planner>::names(); }

std::unique_ptr<Planner> make_planner(const std::string& spec, const AgentConfig& agent) {
  return StrategyRegistry<Planner>::make(spec, agent, "planner");
}

}  // namespace skein::agent
