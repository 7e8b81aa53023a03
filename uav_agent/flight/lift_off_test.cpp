#include "uav_agent/flight/lift_off.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/random_stream.hpp"
#include "uav_agent/testing/look_around.hpp"

namespace skein::agent {
namespace {

OrientedBox box_at(const Vector3d& centre, const Vector3d& size) {
  OrientedBox box;
  box.center = centre;
  box.size = size;
  return box;
}

AgentConfig team_of(std::size_t count) {
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
  AgentConfig agent = team_of(6);
  std::set<double> heights;
  for (const UavIndex self : FirstUavs(6)) {
    agent.self = self;
    const double height = lift_off_height_m(agent, {box_at({30, 0, 10}, {20, 20, 20})}, Vector3d::Zero(), 20.0, 1.2);
    EXPECT_GT(height, 20.0);
    heights.insert(height);
  }
  EXPECT_EQ(heights.size(), 6U);
}

TEST(LiftOff, WithoutALidarItStaysBelowWhatHangsOverTheStartAndClimbsOutOfASite) {
  AgentConfig agent = team_of(1);
  agent.fleet[0].role = Role::photographer;
  const double below = lift_off_height_m(agent, {box_at({0, 0, 15}, {20, 20, 10})}, Vector3d::Zero(), 20.0, 1.2);
  EXPECT_LT(below, 10.0 - agent.me().body_radius_m - 1.0);
  const double above = lift_off_height_m(agent, {box_at({0, 0, 20}, {120, 120, 40})}, Vector3d::Zero(), 0.0, 1.2);
  EXPECT_GT(above, 40.0);
  EXPECT_GE(lift_off_height_m(agent, {}, Vector3d(0, 0, 50), 0.0, 1.2), 50.0) << "never down";
}

OccupancyMap map_with_roof(double height_m) {
  std::vector<Eigen::Vector3f> hits;
  for (double x = -4.0; x <= 4.0; x += 0.5) {
    for (double y = -4.0; y <= 4.0; y += 0.5) hits.push_back(Vector3d(x, y, height_m).cast<float>());
  }
  OccupancyMap map;
  map.insert(hits, std::nullopt);
  return map;
}

TEST(LiftOff, NobodyClimbsIntoARoofWhateverItsHeight) {
  const AgentConfig agent = team_of(2);
  for (std::uint64_t world = 0; world < 30; ++world) {
    RandomStream random(world, "roof", 0);
    const double roof_m = random.uniform(4.5, 20.0), wanted_m = random.uniform(3.0, 25.0);
    OccupancyMap map = map_with_roof(roof_m);
    look_around(map, {0, 0, 1.8}, 40);
    const double open_m = open_height_m(agent, {}, map, {0, 0, 0.2}, 0.2, 0.2 + kRoofM, wanted_m);
    if (wanted_m > roof_m) {
      EXPECT_LT(open_m + agent.me().body_radius_m, roof_m) << world;
    } else {
      EXPECT_LE(open_m, wanted_m) << world;
    }
  }
}

TEST(LiftOff, WhoHasNotLookedUpStaysAsLowAsItStandsFree) {
  const AgentConfig agent = team_of(2);
  OccupancyMap map;
  EXPECT_LT(open_height_m(agent, {}, map, {0, 0, 0.2}, 0.2, 0.2 + kRoofM, 20.0), 2.5);
  look_around(map, {0, 0, 1.8}, 40);
  EXPECT_EQ(open_height_m(agent, {}, map, {0, 0, 0.2}, 0.2, 0.2 + kRoofM, 20.0), 20.0);
  const std::vector<OrientedBox> around = {box_at({0, 0, 20}, {30, 30, 40})};
  const double in_box_m = open_height_m(agent, around, map, {0, 0, 0.2}, 0.2, 0.2 + kRoofM, 30.0);
  EXPECT_GT(in_box_m, 5.0) << "so high it was looked at";
  EXPECT_LT(in_box_m, 15.0) << "and no higher";
}

/// A wall through x that leans by so much a metre towards the start, from the ground up.
OccupancyMap map_with_wall(double x, double lean, double top_m) {
  std::vector<Eigen::Vector3f> hits;
  for (double z = 0.35; z <= top_m; z += 0.1) {
    for (double y = -4.0; y <= 4.0; y += 0.1) hits.push_back(Vector3d(x - lean * z, y, z).cast<float>());
  }
  OccupancyMap map;
  map.insert(hits, std::nullopt);
  return map;
}

TEST(LiftOff, WhoWasSetDownBesideAWallRisesAlongItButNotWhereItLeansOver) {
  const AgentConfig agent = team_of(2);
  const double body_m = agent.me().body_radius_m;
  for (std::uint64_t world = 0; world < 40; ++world) {
    RandomStream random(world, "wall", 0);
    const double wall_m = body_m + random.uniform(0.05, 0.6), top_m = random.uniform(6.0, 15.0);
    const auto open_m = [&](double lean) {
      OccupancyMap map = map_with_wall(wall_m, lean, top_m);
      look_around(map, {-3, 0, 1.8}, 60);
      return open_height_m(agent, {}, map, {0, 0, 0.2}, 0.2, 0.0, top_m + 5.0);
    };
    EXPECT_EQ(open_m(0.0), top_m + 5.0) << world;
    EXPECT_LT(open_m(wall_m / 4.0), 4.0) << world << ": above the start at 4 m";
  }
}

}  // namespace
}  // namespace skein::agent
