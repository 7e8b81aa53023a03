#include "uav_agent/flight/site.hpp"

#include <gtest/gtest.h>

#include <set>

namespace skein::agent {
namespace {

AgentConfig site_fleet(Role first) {
  AgentConfig agent;
  agent.fleet = {{.name = "a", .role = first, .body_radius_m = 0.4}, {.name = "b", .role = Role::photographer}};
  return agent;
}

OrientedBox box_of_height(double height) {
  OrientedBox box;
  box.center = {0.0, 0.0, 0.5 * height};
  box.size = {10.0, 10.0, height};
  return box;
}

TEST(Site, LowSpaceIsBlindWhereALidarCouldSeeIt) {
  const Site site = site_of(site_fleet(Role::explorer), {box_of_height(20.0), box_of_height(80.0)}, 0.45);
  EXPECT_DOUBLE_EQ(site.top_m, 80.0);
  EXPECT_DOUBLE_EQ(site.blind_height_m, 36.0);
  EXPECT_DOUBLE_EQ(site.lowest_m, 0.0);
  EXPECT_DOUBLE_EQ(site.safe_height_m(), 36.0);
  EXPECT_FALSE(site.blind_fleet);
}

TEST(Site, AFleetWithoutALidarStaysHigh) {
  const Site site = site_of(site_fleet(Role::photographer), {box_of_height(80.0)}, 0.45);
  EXPECT_TRUE(site.blind_fleet);
  EXPECT_DOUBLE_EQ(site.blind_height_m, 0.0);
  EXPECT_DOUBLE_EQ(site.lowest_m, 20.0);
  EXPECT_DOUBLE_EQ(site.safe_height_m(), 20.0);
}

TEST(CentreClearance, HoldsTheBodyAndIsNeverFinerThanTheMap) {
  const AgentConfig agent = site_fleet(Role::explorer);
  EXPECT_DOUBLE_EQ(centre_clearance_m(agent, 2.0), 2.4);
  EXPECT_DOUBLE_EQ(centre_clearance_m(agent, 0.3), 1.8);
}

TEST(Due, OncePerPeriodAndInAnotherExchangeWithAnotherOffset) {
  const AgentConfig agent = site_fleet(Role::explorer);
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
