// A UAV that stands beside structure takes off, but not straight above its start.
#include "uav_agent/flight_core/place_aside.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/random_stream.hpp"
#include "uav_agent/flight_core/flight_core.hpp"
#include "uav_agent/testing/flown_uav.hpp"

namespace skein::agent {
namespace {

AgentConfig explorer_at_its_start() {
  AgentConfig agent;
  agent.fleet = {{.name = "a", .p_WB_start = {0.0, 0.0, 0.16}}};
  return agent;
}

/// A UAV that stands on the ground.
struct Climber : FlownUav {
  Climber() : FlownUav(explorer_at_its_start(), {0.0, 0.0, 0.16}) {
    boxes = {make_box({20.0, 0.0, 6.0}, {4.0, 4.0, 12.0})};
    tracker = Tracker(Tracker::Config{.max_acceleration_mps2 = 2.8});  // it stands
  }
  void exchange() {
    PlannerInput in = input();
    in.uncertainty.position_m = deviation_in_flight_m(agent.odometry);
    core.update(in);
    in.flight = core.state();
    works = works || in.flight.working;
    const Steering steering = core.step(in, std::nullopt);
    if (steering.yaw) tracker.turn_to(*steering.yaw);
    if (const auto* path = std::get_if<Path>(&steering.motion)) tracker.follow(*path);
    if (std::holds_alternative<Hold>(steering.motion)) tracker.hold();
    core.move(tracker, {.tick = in.tick, .state = state, .map = map, .boxes = boxes, .peers = peers});
    if (tracker.tracking().airborne) {
      state.p_WB = tracker.commanded().p_WB;
      state.v_WB = tracker.commanded().v_WB;
    }
    was_held = was_held || core.filter().held().by == Held::By::structure;
    nearest_m = std::min(nearest_m, map.structure_distance_m(state.p_WB));
    ++k;
  }

  FlightCore core{config, agent};
  double nearest_m = 1e9;
  bool works = false, was_held = false;
};

/// A UAV beside a wall of 6 m width and 12 m height, at a distance in some direction.
struct BesideAWall : Climber {
  BesideAWall(double direction, double off_m) {
    clear({-12.0, -12.0, 0.0}, {12.0, 12.0, 20.0});
    const Vector3d ahead(std::cos(direction), std::sin(direction), 0.0), along = Vector3d::UnitZ().cross(ahead);
    for (double side_m = -3.0; side_m <= 3.0; side_m += 0.2) {
      const Vector3d foot_W = off_m * ahead + side_m * along;
      build(foot_W, foot_W + Vector3d(0.0, 0.0, 12.0));
    }
  }
};

TEST(PlaceAside, AUavBesideAWallGetsUpAndComesNoNearer) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "place_aside_test", 0);
    BesideAWall uav(random.uniform(-std::numbers::pi, std::numbers::pi), random.uniform(0.9, 2.4));
    const double begun_m = uav.map.structure_distance_m(uav.state.p_WB);
    for (int i = 0; i < 1200 && !uav.works; ++i) uav.exchange();
    EXPECT_TRUE(uav.works) << "seed " << seed << ", " << begun_m << " m off";
    EXPECT_GT(uav.state.p_WB.z(), 1.2) << "seed " << seed;
    EXPECT_GE(uav.nearest_m, begun_m - 0.26) << "seed " << seed << ": the map's distance is of cubes of 0.5 m";
    held += uav.was_held ? 1 : 0;
  }
  EXPECT_GE(held, 4) << "the test needs UAVs that structure holds";
}

TEST(PlaceAside, PlacesHaveMoreRoomThanTheStart) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, "place_aside_test", 1);
    const BesideAWall uav(random.uniform(-std::numbers::pi, std::numbers::pi), random.uniform(0.9, 2.4));
    const std::vector<Vector3d> places_W = places_aside_W(uav.state.p_WB, 6.0, 2.0, uav.map);
    ASSERT_FALSE(places_W.empty()) << "seed " << seed;
    const double here_m = uav.map.structure_distance_m(uav.state.p_WB);
    for (const Vector3d& place_W : places_W) {
      EXPECT_GT(uav.map.structure_distance_m(place_W), here_m);
      EXPECT_EQ(place_W.z(), uav.state.p_WB.z());
    }
    EXPECT_GE(uav.map.structure_distance_m(places_W.front()), 2.0);
  }
}

TEST(PlaceAside, ThereIsNoneWithoutStructureAndNoneInAShaft) {
  FlownUav free(explorer_at_its_start(), {0.0, 0.0, 0.16});
  EXPECT_TRUE(places_aside_W(free.state.p_WB, 6.0, 2.0, free.map).empty());
  for (double angle = 0.0; angle < 6.3; angle += 0.05) {  // rings of 1 to 6 m
    for (double r = 1.0; r < 6.0; r += 0.4) {
      const Vector3d foot_W(r * std::cos(angle), r * std::sin(angle), 0.0);
      free.build(foot_W, foot_W + Vector3d(0.0, 0.0, 8.0));
    }
  }
  EXPECT_TRUE(places_aside_W(free.state.p_WB, 6.0, 2.0, free.map).empty());
}

/// A UAV below one cube that its LiDAR cannot see from the start.
struct UnderABlindCube : Climber {
  explicit UnderABlindCube(const Vector2d& off_m) {
    state.p_WB.head<2>() = Vector2d(0.25, 0.25) + off_m;
    agent.fleet.front().p_WB_start = state.p_WB;
    agent.odometry = conditions_preset("harsh").odometry;
    see(WorldMap::Cube(0, 0, 4));
  }
  /// Proves that all smallest cubes around its way up are free, except for one.
  void see(const WorldMap::Cube& blind) {
    for (int x = -12; x < 12; ++x) {
      for (int y = -12; y < 12; ++y) {
        for (int z = 0; z < 24; ++z) {
          if (WorldMap::Cube(x, y, z) != blind) map.hear({x, y, z}, 0, Space::free, kOwn);
        }
      }
    }
  }
};

TEST(PlaceAside, AUavMovesAsideToSeeTheSpaceRightAboveIt) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(seed, "place_aside_test", 2);
    UnderABlindCube uav({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)});
    const Vector3d begun_W = uav.state.p_WB;
    bool unproved = false;
    for (int i = 0; i < 1200 && !uav.works; ++i) {
      uav.exchange();
      unproved = unproved || uav.core.filter().held().by == Held::By::unproved;
      if ((uav.state.p_WB - begun_W).head<2>().norm() > 0.2) uav.see({-1, -1, -1});
    }
    EXPECT_TRUE(unproved) << seed;
    EXPECT_TRUE(uav.works) << seed << ", at " << uav.state.p_WB.transpose();
  }
}

}  // namespace
}  // namespace skein::agent
