#include "run/exec_variables.hpp"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "core/config/config_files.hpp"
#include "core/planners/uav_planner.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "results/run_folder.hpp"
#include "run/ros_command.hpp"

namespace skein::cli {
namespace {

/// ROS names of a node's radio topics, separated by spaces: those on which it may send, and those that arrive at it.
/// Leaves out the topics of capture reports and their acknowledgements, which need no mention.
std::pair<std::string, std::string> radio_topics_of(const Scenario& scenario, Node node) {
  const auto is_custody = [](const NodeTopic& topic) {
    return topic.ros_type == kCapturesType || topic.ros_type == kCapturesAckType;
  };
  std::vector<std::string> sends, hears;
  const NodeTopics topics = node_topics(scenario, node);
  for (const NodeTopic& topic : topics.sent) {
    if (!is_custody(topic)) sends.push_back(topic.ros_topic);
  }
  for (const NodeTopic& topic : topics.arriving) {
    const std::string name = arrival_topic(topic.ros_topic, scenario.node_name(node));
    if (!is_custody(topic) && std::ranges::find(hears, name) == hears.end()) hears.push_back(name);
  }
  return {joined(sends, " "), joined(hears, " ")};
}

}  // namespace

std::map<std::string, std::string> part_variables(const FleetPlan& plan, const std::string& program) {
  std::map<std::string, std::string> variables;
  Node node = kStationNode;
  if (program != programs::kGroundAgent) {
    const UavIndex uav = plan.scenario.uav_index(programs::member_name(program));
    node = node_of_uav(uav);
    variables["SKEIN_ROLE"] = name_of(plan.scenario.fleet[uav].vehicle.role);
  }
  variables["SKEIN_EXCHANGE_S"] = shortest(seconds(plan.scenario.exchange_ticks()));
  std::tie(variables["SKEIN_RADIO_SENDS"], variables["SKEIN_RADIO_HEARS"]) = radio_topics_of(plan.scenario, node);
  return variables;
}

std::map<std::string, std::string> exec_variables(const FleetPlan& plan, const std::string& program, int base_domain,
                                                  const std::filesystem::path& out, const SecureFolder& secure) {
  const std::string member = programs::member_name(program);
  const std::string domain = std::to_string(agent_domain(plan, program, base_domain));
  std::map<std::string, std::string> variables = {
      {"SKEIN_DOMAIN", domain},
      {"ROS_DOMAIN_ID", domain},  // all that a ROS 2 node needs to discover the fleet on this host
      {"SKEIN_UAV", member},
      {"SKEIN_RUN", std::to_string(plan.run)},
      {"SKEIN_DDS", dds_vendors(plan).at(program)},
      {"SKEIN_SCENARIO", std::filesystem::absolute(plan.scenario.file)},
      {"SKEIN_OUT", std::filesystem::absolute(secure.out.empty() ? out : secure.out)},
      {"SKEIN_CONFIG_DIR", std::filesystem::absolute(default_config_dir())},
      {"SKEIN_BIN_DIR", std::filesystem::absolute(plan.bin_dir)}};  // for skein.client, which is not beside them
  variables.merge(part_variables(plan, program));
  if (plan.options.network) variables["SKEIN_NETWORK"] = *plan.options.network;
  if (!secure.keys.empty()) variables["SKEIN_SECURITY"] = secure.keys;
  if (secure.user) variables["HOME"] = secure.out;  // this user cannot read the launcher's HOME
  return variables;
}

void check_exec(const FleetPlan& plan) {
  const auto is_ros = [](const UavPlanner& planner) { return planner.spec.starts_with(kRos); };
  if (plan.options.secure && std::ranges::any_of(plan.planners, is_ros)) check_secure_middleware(plan.options.dds);
}

}  // namespace skein::cli
