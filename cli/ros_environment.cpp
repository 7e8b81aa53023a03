#include "cli/ros_environment.hpp"

#include <spdlog/fmt/fmt.h>

#include "core/config/network_config.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/topics.hpp"
#include "host/fleets.hpp"
#include "results/run_folder.hpp"
#include "run/drawn_world.hpp"
#include "run/fleet_plan.hpp"
#include "run/ros_command.hpp"

namespace skein::cli {
namespace {

struct Fleet {
  Scenario scenario;
  int base_domain = 0;
  std::string network;
  std::map<std::string, std::string> keys = {};  ///< folders of a secured fleet, by program
};

Fleet planned_fleet(const RunOptions& options) {
  return {scenario_flown(options, false), *options.domain, options.network.value_or("")};
}

Fleet flying_fleet(const RunOptions& options) {
  const RunningFleet fleet = chosen_fleet(options.out, "--ros-env (without --domain)", "--out");
  LoadOptions load;
  load.uavs = fleet.uavs;
  load.needs_scene_files = false;
  return {load_scenario(fleet.scenario, load), fleet.base_domain, fleet.network, fleet.keys};
}

/// Raises Cyclone DDS's limit of about ten participants per domain and host; the fleet itself has three of them.
std::string cyclonedds_discovery(const std::vector<std::string>& peers) {
  std::string text = "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>31</MaxAutoParticipantIndex>";
  if (!peers.empty()) {
    text += "<Peers>";
    for (const std::string& peer : peers) text += "<Peer address=\"" + peer + "\"/>";
    text += "</Peers>";
  }
  return "<Discovery>" + text + "</Discovery>";
}

}  // namespace

RosPlace ros_place(const RunOptions& options) {
  const Fleet fleet = options.domain ? planned_fleet(options) : flying_fleet(options);
  const UavIndex uav = fleet.scenario.uav_index(*options.ros_env);
  RosPlace place{*options.ros_env, uav_domain(fleet.base_domain, uav)};
  const auto keys = fleet.keys.find(programs::agent_program(place.uav));
  if (keys != fleet.keys.end()) place.keys = keys->second;
  if (!fleet.network.empty()) place.peers = read_network(fleet.network).of(place.uav).peers;
  return place;
}

std::string shell_lines(const RosPlace& place) {
  std::string lines = fmt::format("export ROS_DOMAIN_ID={}\n", place.domain);
  lines += "unset ROS_DISCOVERY_SERVER\n";
  lines += "export CYCLONEDDS_URI=" + shell_word(cyclonedds_discovery(place.peers)) + "\n";
  const auto skein_ros = skein_ros_prefix();
  if (skein_ros && place.peers.empty()) {
    lines += "export FASTRTPS_DEFAULT_PROFILES_FILE=" + shell_word(fastdds_profile(*skein_ros)) + "\n";
  } else {
    lines += "unset FASTRTPS_DEFAULT_PROFILES_FILE\n";
  }
  if (!place.keys.empty()) {
    lines += enclave_command(shell_word(place.keys)) + "\n";
    if (skein_ros && place.peers.empty()) lines += loopback_command(*skein_ros) + "\n";
  }
  if (!place.peers.empty()) {
    lines += "# rmw_fastrtps_cpp needs a profile with these initial peers: " + joined(place.peers) + "\n";
  }
  lines += fmt::format("# for each node: --ros-args -p use_sim_time:=true -r __ns:=/{}\n", place.uav);
  return lines;
}

}  // namespace skein::cli
