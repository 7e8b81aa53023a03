// Tests when a UAV without a LiDAR assumes that space is free, and when it stops.
#include "uav_agent/flight_core/sight.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

AgentConfig photographer_with_explorer() {
  AgentConfig agent;
  agent.self = UavIndex(1);
  agent.fleet = {{.name = "a", .p_WB_start = {0.0, 80.0, 0.0}},
                 {.name = "b", .role = Role::photographer, .body_radius_m = 0.32}};
  return agent;
}

/// A photographer that stands at its start, and has received a map of some other place.
struct Stands : FlownUav {
  explicit Stands(std::uint64_t seed) : FlownUav(photographer_with_explorer(), {0.0, 0.0, 0.1}) {
    lidar_works = false;
    map.set_free(state.p_WB, 1.2);
    RandomStream random(seed, "told_space", 0);
    const double turn = random.uniform(0.0, 6.28), off_m = random.uniform(45.0, 60.0);
    low_W = Vector3d(off_m * std::cos(turn) - 20.0, off_m * std::sin(turn) - 20.0, 0.0);
    clear(low_W, low_W + Vector3d(40.0, 40.0, 20.0));
  }
  void listen(double time_s) {
    for (int i = 0; i < time_s * 20.0; ++i, ++k) told.listen(input(), false, filter);
  }
  Vector3d low_W;
  ToldSpace told{config, agent};
};

// The UAVs that sent the map of the other place may be lost.
TEST(ToldSpace, AMapOfAnotherPlaceKeepsNoUavOnTheGround) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Stands uav(seed);
    uav.listen(uav.config.alone_s - 1.0);
    EXPECT_FALSE(uav.filter.assumes_boxes()) << "seed " << seed;
    uav.listen(2.0);
    EXPECT_TRUE(uav.filter.assumes_boxes()) << "seed " << seed;
  }
}

TEST(ToldSpace, AUavThatReceivesMapUpdatesWaits) {
  Stands uav(1);
  for (int i = 0; i < 20; ++i) {
    uav.listen(20.0);
    EXPECT_FALSE(uav.filter.assumes_boxes()) << i;
    uav.clear(uav.low_W + Vector3d(0.0, 0.0, 20.0 + 2.0 * i), uav.low_W + Vector3d(2.0, 2.0, 22.0 + 2.0 * i));
  }
}

TEST(ToldSpace, AUavStopsAssumingFreeSpaceOnceItIsInProvedSpace) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Stands uav(seed);
    uav.listen(uav.config.alone_s + 1.0);
    for (const double height_m : {0.1, 1.0, 4.0}) {
      uav.state.p_WB.z() = height_m;
      uav.listen(1.0);
      EXPECT_TRUE(uav.filter.assumes_boxes()) << "seed " << seed << ", at " << height_m << " m";
    }
    uav.state.p_WB = uav.low_W + Vector3d(10.0, 10.0, 10.0);
    uav.listen(1.0);
    EXPECT_FALSE(uav.filter.assumes_boxes()) << "seed " << seed;
    uav.listen(5.0 * uav.config.alone_s);
    EXPECT_FALSE(uav.filter.assumes_boxes()) << "seed " << seed << ": it has its map";
  }
}

}  // namespace
}  // namespace skein::agent
