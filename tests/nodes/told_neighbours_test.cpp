// If odometry has errors, a UAV receives the positions that the other UAVs estimate, not the true ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/scenario/scenario_reader.hpp"
#include "idl/conversions.hpp"
#include "scenes/scene_source.hpp"
#include "sim_server/uav_node.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

TEST(ToldNeighbours, HaveThePositionsOfTheirOwnOdometry) {
  const Scenario scenario =
      load_scenario("towers", {.config_dir = source_path("config"), .conditions = "odometry=harsh"});
  const Scene scene = sim::load_scene(scenario);
  sim::Simulation simulation(scenario, scene, 3);
  std::size_t compared = 0;
  double most_off_m = 0.0;
  for (int k = 0; k < 160; ++k) {
    for (const UavIndex uav : scenario.uavs()) {
      const Vector2d& start = scenario.fleet[uav].start;
      simulation.command_trajectory(uav, {.p_WB = {start.x() + 0.1, start.y(), 4.0}});
    }
    simulation.advance();
    for (const UavIndex uav : scenario.uavs()) {
      const msg::PointCloud2 cloud = sim::neighbour_cloud(simulation, scenario, node_of_uav(uav));
      for (const NeighbourPoint& point : from_cloud<NeighbourPoint>(cloud)) {
        if (point.node == 0.0F) continue;  // the station
        const sim::UavView& other = simulation.uav(UavIndex(static_cast<std::size_t>(point.node) - 1));
        const Eigen::Vector3f p_W(point.x, point.y, point.z);
        ASSERT_EQ(p_W, other.told.p_WB.cast<float>());
        ASSERT_EQ(point.t, seconds(other.told_tick));
        most_off_m = std::max(most_off_m, (other.told.p_WB - other.state.p_WB).norm());
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100U);
  EXPECT_GT(most_off_m, 0.1) << "odometry deviates by 10 cm along each axis from the start on";
}

}  // namespace
}  // namespace skein::test
