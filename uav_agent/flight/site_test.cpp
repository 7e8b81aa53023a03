#include "uav_agent/flight/site.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {
namespace {

TEST(Site, TopIsThatOfTheHighestCornerHoweverABoxIsTurned) {
  OrientedBox low, tilted;
  low.size = {10.0, 10.0, 4.0};
  tilted.center = {0.0, 0.0, 20.0};
  tilted.size = {6.0, 2.0, 8.0};
  tilted.R_WO = Eigen::AngleAxisd(0.5, Vector3d::UnitY()).toRotationMatrix();
  EXPECT_DOUBLE_EQ(top_of({}), 0.0);
  EXPECT_DOUBLE_EQ(top_of({low}), 2.0);
  EXPECT_NEAR(top_of({low, tilted}), 20.0 + 3.0 * std::sin(0.5) + 4.0 * std::cos(0.5), 1e-9);
}

TEST(Site, ASiteBoxIsWideBothWaysAndHigh) {
  OrientedBox box;
  box.size = {50.0, 60.0, 30.0};
  EXPECT_TRUE(is_site_box(box));
  for (int axis = 0; axis < 3; ++axis) {
    OrientedBox narrow = box;
    narrow.size[axis] = 15.0;
    EXPECT_FALSE(is_site_box(narrow)) << axis;
  }
}

TEST(Due, OncePerPeriodAndInAnotherExchangeWithAnotherOffset) {
  const AgentConfig agent;
  std::set<std::uint64_t> first, second;
  for (std::uint64_t k = 0; k < 100; ++k) {
    if (agent.due(k, 0.5, 0)) first.insert(k % 10);
    if (agent.due(k, 0.5, 3)) second.insert(k % 10);
    EXPECT_TRUE(agent.due(k, 0.0, 0)) << "at most once an exchange";
  }
  EXPECT_EQ(first, std::set<std::uint64_t>({0}));
  EXPECT_EQ(second, std::set<std::uint64_t>({7}));
}

}  // namespace
}  // namespace skein::agent
