// Planners that others wrote include headers by the places where they stood before they moved: those still bring what
// they brought.
#include <gtest/gtest.h>

#include "uav_agent/agent_config.hpp"
#include "uav_agent/block_work.hpp"
#include "uav_agent/free_space.hpp"
#include "uav_agent/ground_program.hpp"
#include "uav_agent/messages.hpp"
#include "uav_agent/motion.hpp"
#include "uav_agent/occupancy_map.hpp"
#include "uav_agent/path_search.hpp"
#include "uav_agent/peers.hpp"
#include "uav_agent/planner.hpp"
#include "uav_agent/planning/aiming.hpp"
#include "uav_agent/planning/fleet_tours.hpp"
#include "uav_agent/planning/frontiers.hpp"
#include "uav_agent/planning/map_exchange.hpp"
#include "uav_agent/planning/payload.hpp"
#include "uav_agent/planning/rounding.hpp"
#include "uav_agent/planning/tours.hpp"
#include "uav_agent/planning/viewpoints.hpp"
#include "uav_agent/planning/voxel_grid.hpp"
#include "uav_agent/planning/voxel_route.hpp"
#include "uav_agent/planning/voxel_search.hpp"
#include "uav_agent/site.hpp"
#include "uav_agent/standoff.hpp"
#include "uav_agent/strategy_registry.hpp"
#include "uav_agent/strips.hpp"
#include "uav_agent/work_share.hpp"

namespace skein::agent {
namespace {

/// As somebody may have written it: an index is a number, and the planner's header is all that it includes.
class FormerPlanner final : public Planner {
 public:
  explicit FormerPlanner(const AgentConfig& agent) : self_(agent.self), fleet_(agent.fleet.size()) {}
  PlannerOutput plan(const PlannerInput& input) override {
    std::size_t nearest = fleet_;
    for (const Peer& peer : input.peers.all()) nearest = peer.uav;
    return {.motion = nearest > self_ && input.map.occupied_cells() == 0 ? Motion(Hold{}) : Motion()};
  }

 private:
  const std::size_t self_, fleet_;
};

TEST(FormerIncludes, AreEnoughForAPlanner) {
  AgentConfig agent;
  agent.fleet.resize(2);
  const OccupancyMap map;
  const Peers peers(agent);
  const std::vector<OrientedBox> boxes;
  const PlannerInput input{.state = {},
                           .gimbal = {},
                           .tracking = {},
                           .map = map,
                           .boxes = boxes,
                           .peers = peers,
                           .mission_remaining_s = {},
                           .detected = {},
                           .radio = {}};
  EXPECT_TRUE(std::holds_alternative<Hold>(FormerPlanner(agent).plan(input).motion));
}

}  // namespace
}  // namespace skein::agent
