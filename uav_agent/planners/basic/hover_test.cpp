// Tests the planner hover in TestWorld, a world without physics.
#include <gtest/gtest.h>

#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

TEST(Hover, StaysAtItsHeightIfItIsRestartedInFlight) {
  TestWorld world(two_towers(), test_fleet(1), "hover", 40.0);
  world.run(20.0);
  EXPECT_NEAR(world.position(0).z(), 3.0, 0.3);
  world.restart(0);
  world.run(20.0);
  EXPECT_NEAR(world.position(0).z(), 3.0, 0.3);
}

}  // namespace
}  // namespace skein::agent
