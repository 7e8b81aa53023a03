// The on-board software accepts no structure at its own UAV's place, whatever maps other UAVs send.
#include <gtest/gtest.h>

#include "uav_agent/maps/world_map.hpp"
#include "uav_agent/onboard/agent.hpp"
#include "uav_agent/onboard/map_radio.hpp"

namespace skein::agent {
namespace {

/// The LiDAR of a UAV that did not hear this UAV saw it, and took it for structure.
TEST(OwnPlace, AUavIgnoresReportsOfStructureAtItsOwnPlace) {
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

/// An explorer that did not hear this UAV while it flew mapped its body all along the way. When the two hear each other
/// again, the explorer reports this; and a new pole beside the way, which must enter the map.
TEST(OwnPlace, AUavIgnoresReportsOfItsOwnUnheardFlightAsStructure) {
  struct Looker final : Planner {
    PlannerOutput plan(const PlannerInput& in) override {
      map = in.world_map;
      return {};
    }
    bool wants_world_map() const override { return true; }
    const WorldMap* map = nullptr;
  };
  AgentConfig explorer;
  explorer.fleet.resize(2);
  AgentConfig photographer = explorer;
  photographer.self = UavIndex(1);
  photographer.fleet[1].role = Role::photographer;
  photographer.vehicle.lidar.reset();
  auto planner = std::make_unique<Looker>();
  const Looker& looker = *planner;
  Agent agent(photographer, std::move(planner));
  MapRadio radio(explorer);
  Peers peers(explorer);
  WorldMap seen{WorldMap::Config()};
  AgentInput input;
  input.state.p_WB = {0.0, 0.0, 10.0};
  const auto exchange = [&](bool heard) {
    input.radio.clear();
    input.neighbours.clear();
    if (heard) {
      input.neighbours = {{node_of_uav(UavIndex{0}), {0.0, 30.0, 10.0}}};
      peers.update(input.tick, {{node_of_uav(UavIndex{1}), input.state.p_WB}});
      if (auto message = radio.tell(seen, peers, std::nullopt, input.tick)) input.radio.push_back(*message);
    } else {
      peers.update(input.tick, {});
    }
    agent.step(input);
    ++input.k;
    input.tick += 20;
  };
  seen.set_free({5.0, 0.0, 10.0}, 12.0);
  for (int k = 0; k < 200; ++k) exchange(true);
  ASSERT_EQ(looker.map->at({8.0, 0.0, 10.0}), Space::free);

  std::vector<Vector3d> body_W;
  for (int k = 0; k < 100; ++k) {
    input.state.p_WB.x() = 0.1 * k;
    exchange(false);
    body_W.emplace_back(input.state.p_WB + Vector3d(0.0, k % 2 == 0 ? 0.5 : -0.5, 0.3));
    seen.insert({}, std::vector<Eigen::Vector3f>{body_W.back().cast<float>()});
  }
  const Vector3d pole_W(5.0, 4.0, 10.0);
  seen.insert({}, std::vector<Eigen::Vector3f>{pole_W.cast<float>()});
  for (int k = 0; k < 200; ++k) exchange(true);
  EXPECT_EQ(looker.map->at(pole_W), Space::occupied);
  for (const Vector3d& p_W : body_W) EXPECT_EQ(looker.map->at(p_W), Space::free) << p_W.transpose();
}

}  // namespace
}  // namespace skein::agent
