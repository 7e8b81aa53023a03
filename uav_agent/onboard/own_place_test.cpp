// The on-board software knows that its UAV occupies its own place, whatever maps the others send.
#include <gtest/gtest.h>

#include "uav_agent/maps/world_map.hpp"
#include "uav_agent/onboard/agent.hpp"
#include "uav_agent/onboard/map_radio.hpp"

namespace skein::agent {
namespace {

/// A LiDAR of a UAV that did not hear this one met it, and took it for structure.
TEST(OwnPlace, WhatOthersToldToStandThereIsNothing) {
  struct Looker final : Planner {
    PlannerOutput plan(const PlannerInput& in) override {
      here = in.world_map->at(in.state.p_WB);
      aside = in.world_map->at({5.0, 0.0, 10.0});
      return {};
    }
    bool wants_world_map() const override { return true; }
    Space here = Space::unknown, aside = Space::unknown;
  };
  auto planner = std::make_unique<Looker>();
  const Looker& looker = *planner;
  AgentConfig fleet;
  fleet.fleet.resize(2);
  AgentConfig listener = fleet;
  listener.self = UavIndex(1);
  listener.vehicle.lidar.reset();
  Agent agent(listener, std::move(planner));
  AgentInput input;
  input.state.p_WB = {0.0, 0.0, 10.0};
  MapRadio radio(fleet);
  Peers peers(fleet);
  peers.update(0, {{node_of_uav(UavIndex{1}), {0, 0, 10}}});
  WorldMap told{WorldMap::Config()};
  told.insert({}, std::vector<Eigen::Vector3f>{{0.1F, 0.1F, 10.1F}, {5.0F, 0.0F, 10.0F}});
  for (int k = 0; k < 200; ++k) {
    input.radio.clear();
    if (auto message = radio.tell(told, peers, std::nullopt, input.tick)) input.radio.push_back(*message);
    input.k = static_cast<std::uint64_t>(k);
    input.tick += 20;
    agent.step(input);
  }
  EXPECT_EQ(looker.aside, Space::occupied);
  EXPECT_EQ(looker.here, Space::free);
}

}  // namespace
}  // namespace skein::agent
