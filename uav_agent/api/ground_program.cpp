#include "uav_agent/api/ground_program.hpp"

namespace skein::agent {

std::vector<std::string> ground_program_names() { return StrategyRegistry<GroundProgram>::names(); }

std::unique_ptr<GroundProgram> make_ground_program(const std::string& spec, const AgentConfig& ground) {
  return StrategyRegistry<GroundProgram>::make(spec, ground, "program at the ground station called");
}

AgentConfig ground_config(const Scenario& scenario) {
  AgentConfig config = agent_config(scenario, UavIndex{});
  config.self = UavIndex(config.fleet.size());  // no UAV
  config.vehicle = {};
  return config;
}

}  // namespace skein::agent
