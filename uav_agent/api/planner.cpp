#include "uav_agent/api/planner.hpp"

#include <filesystem>

namespace skein::agent {
namespace {

/// "hand:jurong.csv" becomes "hand:file=jurong.csv": a table is the value of one parameter, not a file of parameters.
std::string with_table_named(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos || spec.find('=', colon) != std::string::npos) return spec;
  if (std::filesystem::path(spec.substr(colon + 1)).extension() != ".csv") return spec;
  return spec.substr(0, colon + 1) + "file=" + spec.substr(colon + 1);
}

}  // namespace

std::vector<std::string> planner_names() { return StrategyRegistry<Planner>::names(); }

std::unique_ptr<Planner> make_planner(const std::string& spec, const AgentConfig& agent) {
  return StrategyRegistry<Planner>::make(with_table_named(spec), agent, "planner");
}

}  // namespace skein::agent
