#include "uav_agent/flight/lift_off.hpp"

#include <gtest/gtest.h>

#include <set>

namespace skein::agent {
namespace {

OrientedBox box_at(const Vector3d& centre, const Vector3d& size) {
  OrientedBox box;
  box.center = centre;
  box.size = size;
  return box;
}

AgentConfig fleet_of(std::size_t count) {
  AgentConfig agent;
  agent.fleet.resize(count);
  return agent;
}

TEST(LiftOff, ALowSiteIsBlindUpToItsTopAHighOneInPart) {
  EXPECT_DOUBLE_EQ(blind_height_m({}, 0.45), 0.0);
  EXPECT_DOUBLE_EQ(blind_height_m({box_at({0, 0, 10}, {20, 20, 20})}, 0.45), 20.0);
  EXPECT_DOUBLE_EQ(blind_height_m({box_at({0, 0, 30}, {20, 20, 60})}, 0.45), 27.0);
}

TEST(LiftOff, EverybodyGetsALayerOfItsOwn) {
  AgentConfig agent = fleet_of(6);
  std::set<double> heights;
  for (const UavIndex self : FirstUavs(6)) {
    agent.self = self;
    const double height = lift_off_height_m(agent, {box_at({30, 0, 10}, {20, 20, 20})}, Vector3d::Zero(), 20.0, 1.2);
    EXPECT_GT(height, 20.0);
    heights.insert(height);
  }
  EXPECT_EQ(heights.size(), 6U);
}

TEST(LiftOff, StaysBelowWhatHangsOverTheStartAndClimbsOutOfASite) {
  const AgentConfig agent = fleet_of(1);
  const double below = lift_off_height_m(agent, {box_at({0, 0, 15}, {20, 20, 10})}, Vector3d::Zero(), 20.0, 1.2);
  EXPECT_LT(below, 10.0 - agent.me().body_radius_m - 1.0);
  const double above = lift_off_height_m(agent, {box_at({0, 0, 20}, {120, 120, 40})}, Vector3d::Zero(), 0.0, 1.2);
  EXPECT_GT(above, 40.0);
  EXPECT_GE(lift_off_height_m(agent, {}, Vector3d(0, 0, 50), 0.0, 1.2), 50.0) << "never down";
}

}  // namespace
}  // namespace skein::agent
