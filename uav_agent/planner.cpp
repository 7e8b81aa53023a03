#include "uav_agent/planner.hpp"

#include <map>

#include "core/suggestion.hpp"

namespace skein::agent {
namespace {

/// Constructed on first use, because planners register before main() in no particular order.
std::map<std::string, PlannerFactory>& registry() {
  static std::map<std::string, PlannerFactory> factories;
  return factories;
}

}  // namespace

bool register_planner(const std::string& name, PlannerFactory factory) {
  const bool is_new = registry().emplace(name, factory).second;
  if (!is_new) throw std::logic_error("two planners are registered as '" + name + "'");
  return true;
}

std::vector<std::string> planner_names() {
  std::vector<std::string> names;
  for (const auto& entry : registry()) names.push_back(entry.first);
  return names;
}

std::unique_ptr<Planner> make_planner(const std::string& spec, const AgentConfig& agent) {
  const auto colon = spec.find(':');
  const std::string name = spec.substr(0, colon);
  const std::string parameters = colon == std::string::npos ? "" : spec.substr(colon + 1);
  const auto found = registry().find(name);
  if (found == registry().end()) {
    throw InputError("--planner: there is no planner '" + name + "'; " + suggestion(name, planner_names()));
  }
  const bool is_file = !parameters.empty() && parameters.find('=') == std::string::npos;
  return found->second(is_file ? read_config_document(parameters) : parse_assignments(parameters, "--planner " + name),
                       agent);
}

}  // namespace skein::agent
