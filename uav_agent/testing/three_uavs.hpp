// A fleet of three for tests: an explorer and two photographers.
#pragma once

#include <string>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/peers.hpp"

namespace skein::agent {

/// Configuration of the agent with the index `self`.
inline AgentConfig three_uavs(std::size_t self) {
  AgentConfig agent;
  agent.self = UavIndex(self);
  for (int i = 0; i < 3; ++i) {
    agent.fleet.push_back({.name = "uav" + std::to_string(i),
                           .role = i == 0 ? Role::explorer : Role::photographer,
                           .p_WB_start = {5.0 * i, -20.0, 0.0}});
  }
  agent.vehicle.camera = VehicleConfig().camera;
  return agent;
}

/// Peers of an agent that has all other UAVs in line of sight.
inline Peers all_in_sight(const AgentConfig& agent) {
  Peers peers(agent);
  std::vector<Neighbour> neighbours;
  for (std::size_t uav = 0; uav < agent.fleet.size(); ++uav) {
    if (uav != agent.self) neighbours.push_back({.node = node_of_uav(UavIndex(uav)), .p_W = {1.0, 2.0, 3.0}});
  }
  peers.update(1, neighbours);
  return peers;
}

}  // namespace skein::agent
