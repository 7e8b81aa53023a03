// Tests the parts of the STAR planner: boxes, frontiers, surfaces, tours, paths, camera, messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "uav_agent/planners/star/camera.hpp"
#include "uav_agent/planners/star/explorer.hpp"
#include "uav_agent/planners/star/knowledge.hpp"
#include "uav_agent/planners/star/site.hpp"
#include "uav_agent/planners/star/surfaces.hpp"
#include "uav_agent/planners/star/talk.hpp"
#include "uav_agent/planners/star/tour.hpp"
#include "uav_agent/planners/star/way.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

TEST(StarCamera, TurnsDuringTheWholeFlightAndLooksAtTheSurfaceOnArrival) {
  StarCamera camera(VehicleConfig(), true);
  RigidBodyState state;
  const GimbalState gimbal;
  const Vector3d view(10.0, 0.0, 5.0), surface(10.0, 5.0, 2.0);
  double last = -1.0;
  for (double x = 0.0; x <= 10.0; x += 1.0) {
    state.p_WB = {x, 0.0, 5.0};
    PlannerOutput out;
    camera.sweep(state, gimbal, view, surface, out);
    ASSERT_TRUE(out.yaw);
    EXPECT_GT(*out.yaw, last) << "the camera never rests";
    last = *out.yaw;
    const auto* command = std::get_if<GimbalCommand>(&out.gimbal);
    ASSERT_NE(command, nullptr);
    if (x < 10.0) continue;
    EXPECT_NEAR(*out.yaw, std::numbers::pi / 2.0, 1e-9);
    EXPECT_NEAR(command->pitch, std::atan2(3.0, 5.0), 1e-9);
  }
}

/// If the flight core turns the body, the gimbal alone points the camera at the target, up to its limit in yaw.
TEST(StarCamera, OnlyTheGimbalTurnsIfTheFlightCoreTurnsTheBody) {
  VehicleConfig vehicle;
  vehicle.gimbal.yaw_limit_deg = 90.0;
  StarCamera camera(vehicle, false);
  for (int i = 0; i < 36; ++i) {
    const double heading = 0.3, to = wrap_angle(heading + 10.0 * i * kRadPerDeg);
    RigidBodyState state;
    state.q_WB = Eigen::AngleAxisd(heading, Vector3d::UnitZ());
    PlannerOutput out;
    camera.look_at(state, {20.0 * std::cos(to), 20.0 * std::sin(to), -20.0}, out);
    EXPECT_FALSE(out.yaw);
    const auto* command = std::get_if<GimbalCommand>(&out.gimbal);
    ASSERT_NE(command, nullptr);
    const double aside = std::clamp(wrap_angle(to - heading), -std::numbers::pi / 2.0, std::numbers::pi / 2.0);
    EXPECT_NEAR(command->yaw, aside, 1e-9);
    EXPECT_NEAR(command->pitch, std::numbers::pi / 4.0, 1e-9);
  }
}

TEST(StarWay, FollowsThePlacesUpToTheHorizon) {
  const OccupancyMap map;
  const std::vector<OrientedBox> no_boxes;
  const FreeSpace space(FreeSpace::Config(), no_boxes, map);
  std::vector<Vector3d> places;
  for (int i = 1; i <= 8; ++i) places.emplace_back(6.0 * i, i % 2 * 6.0, 10.0);
  double length = 0.0;
  Vector3d at(0, 0, 10);
  for (const Waypoint& waypoint : star_way(space, at, places, {})) {
    length += (waypoint.p_WB - at).norm();
    at = waypoint.p_WB;
    EXPECT_DOUBLE_EQ(waypoint.speed_mps, 2.0);
  }
  EXPECT_GT(length, 12.0);
  EXPECT_LT(length, 20.0 + 9.0) << "the way ends at most one leg beyond the horizon";
}

/// Places are random, and some are too low to be free. Every leg of the path must be in free space, and the path must
/// end at the last place before the first one that is not free.
TEST(StarWay, NeverLeavesFreeSpace) {
  const OccupancyMap map;
  const std::vector<OrientedBox> no_boxes;
  const FreeSpace space(FreeSpace::Config(), no_boxes, map);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    RandomStream random(seed, "places", 0);
    std::vector<Vector3d> places;
    for (int i = 0; i < 6; ++i) {
      places.emplace_back(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(0.5, 12));
    }
    const auto low = std::ranges::find_if(places, [&](const Vector3d& p) { return !space.free(p); });
    const Vector3d from(0, 0, 6);
    const auto way = star_way(space, from, places, {.horizon_m = 1e3});
    EXPECT_EQ(way.empty(), low == places.begin()) << "seed " << seed;
    if (way.empty()) continue;
    EXPECT_EQ(way.back().p_WB, *(low - 1)) << "seed " << seed;
    Vector3d at = from;
    for (const Waypoint& waypoint : way) {
      EXPECT_TRUE(space.segment_free(at, waypoint.p_WB)) << "seed " << seed;
      at = waypoint.p_WB;
    }
  }
}

TEST(StarSite, NoCubeBelongsToTwoBoxes) {
  const std::vector<OrientedBox> boxes = {make_box({0, 0, 10}, {20, 20, 20}), make_box({15, 0, 10}, {20, 20, 20})};
  const VoxelGrid grid = star_grid(boxes, StarConfig(), 7.36);
  EXPECT_LE(grid.count(), 120'000U);
  const auto first = cubes_of_boxes(grid, boxes, {0}), second = cubes_of_boxes(grid, boxes, {1});
  std::vector<VoxelGrid::Id> both;
  std::ranges::set_intersection(first, second, std::back_inserter(both));
  EXPECT_FALSE(first.empty());
  EXPECT_FALSE(second.empty());
  EXPECT_TRUE(both.empty());
}

/// A wall in the plane x = 0, occupied on the world map, and a grid with cubes of 2 m. The tests look at it from x > 0.
struct Wall {
  VoxelGrid grid{Isometry3d(Eigen::Translation3d(-6.0, -16.0, 0.0)), {32.0, 32.0, 20.0}, 2.0};
  WorldMap map{WorldMap::Config()};
  OccupancyMap hits;
  WorldVoxels voxels;
  std::vector<VoxelGrid::Id> cubes;
  std::vector<OrientedBox> no_boxes;

  Wall() {
    for (int y = -20; y < 20; ++y) {
      for (int z = 8; z < 32; ++z) map.hear({0, y, z}, 0, Space::occupied, kOwn);
    }
    voxels.update(map, grid);
    for (VoxelGrid::Id id = 0; id < grid.count(); ++id) cubes.push_back(id);
  }
  FreeSpace space() const { return {{.world = &map}, no_boxes, hits}; }
  std::size_t open_faces(int face) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        cubes, [&](VoxelGrid::Id id) { return grid.state(id) == VoxelState::occupied && !grid.marked(id, face); }));
  }
};

TEST(StarSurfaces, ViewpointsStandOffTheSurfaceAndCoverAllOfIt) {
  Wall wall;
  StarSurfaces surfaces(StarSurfaces::Config(), VehicleConfig(), wall.grid);
  const auto views = surfaces.views(wall.grid, wall.cubes, wall.voxels, wall.space(), {10, 0, 10}, 0);
  std::set<std::uint32_t> front;
  for (const StarView& view : views) {
    EXPECT_GT((view.p_WB - view.surface_W).norm(), 1.8);
    EXPECT_LT((view.p_WB - view.surface_W).norm(), 7.36);
    for (const std::uint32_t face : view.faces) {
      if (face % VoxelGrid::kFaces != 0) continue;
      EXPECT_TRUE(front.insert(face).second) << "each face is in one patch only";
    }
  }
  EXPECT_EQ(front.size(), wall.open_faces(0)) << "every face towards +x has a viewpoint";
}

TEST(StarSurfaces, FacesInThePictureCountAsInspected) {
  Wall wall;
  const StarSurfaces surfaces(StarSurfaces::Config(), VehicleConfig(), wall.grid);
  const std::size_t before = wall.open_faces(0);
  RigidBodyState state;
  state.p_WB = {5.0, 0.0, 10.0};
  surfaces.mark_seen(state, {}, wall.voxels, wall.grid);
  EXPECT_EQ(wall.open_faces(0), before) << "it looks away";
  state.q_WB = Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitZ());
  surfaces.mark_seen(state, {}, wall.voxels, wall.grid);
  EXPECT_LT(wall.open_faces(0), before);
  EXPECT_GT(wall.open_faces(0), 0U) << "not all of it was in the picture";
  EXPECT_EQ(wall.open_faces(1), before) << "its back was not in the picture";
  state.p_WB.x() = 12.0;
  Wall far;
  surfaces.mark_seen(state, {}, far.voxels, far.grid);
  EXPECT_EQ(far.open_faces(0), before) << "too far away";
}

TEST(StarSurfaces, AFailedViewIsTriedAgainLater) {
  Wall wall;
  StarSurfaces surfaces(StarSurfaces::Config(), VehicleConfig(), wall.grid);
  const auto views = [&](Tick now) {
    return surfaces.views(wall.grid, wall.cubes, wall.voxels, wall.space(), {10, 0, 10}, now);
  };
  const auto all = views(0);
  ASSERT_GT(all.size(), 1U);
  const auto shares_a_face = [&](const StarView& view) {
    return std::ranges::find_first_of(view.faces, all.front().faces) != view.faces.end();
  };
  surfaces.failed(all.front(), 0);
  EXPECT_TRUE(std::ranges::none_of(views(ticks(1.0)), shares_a_face));
  EXPECT_TRUE(std::ranges::any_of(views(ticks(60.0)), shares_a_face));
}

/// Random cubes of the world map are occupied, and the map doubts some of these, because they may have been a UAV. The
/// viewpoints must cover exactly the occupied cubes in the team's boxes that the map does not doubt.
TEST(StarKnowledge, ViewpointsCoverTheOccupiedCubesInTheTeamsBoxes) {
  AgentConfig agent;
  agent.fleet = {{.name = "a", .role = Role::explorer, .p_WB_start = {-20.0, 0.0, 0.0}},
                 {.name = "b", .role = Role::photographer, .p_WB_start = {-25.0, 0.0, 0.0}}};
  agent.self = UavIndex(1);
  const std::vector<OrientedBox> boxes = {make_box({0, 0, 10}, {16, 16, 16}), make_box({40, 0, 10}, {16, 16, 16})};
  const OccupancyMap hits;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "surface", 0);
    WorldMap map{WorldMap::Config()};
    std::vector<WorldMap::Cube> met;
    for (int i = 0; i < 12; ++i) {
      const Vector3d p_W(random.uniform(-8, 48), random.uniform(-8, 8), random.uniform(4, 17));
      met.push_back(map.cube_of(p_W));
      map.hear(met.back(), 0, Space::occupied, kOwn + 1);
      if (i % 3 == 0) map.doubt(met.back());
    }
    StarKnowledge known(StarConfig().resolved(), agent, boxes, {0});
    known.look_at_map(map, {0, 0, 30});
    const FreeSpace space({.world = &map}, boxes, hits);
    std::set<VoxelGrid::Id> seen, expected;
    for (const StarView& view : known.views(space, {0, 0, 20}, 0)) {
      for (const std::uint32_t face : view.faces) seen.insert(face / VoxelGrid::kFaces);
    }
    const auto own = cubes_of_boxes(known.grid(), boxes, {0});
    for (const WorldMap::Cube& cube : met) {
      const auto id = known.grid().at(Vector3d((cube.cast<double>() + Vector3d::Constant(0.5)) * map.config().cell_m));
      if (!map.doubted(cube) && std::ranges::binary_search(own, *id)) expected.insert(*id);
    }
    EXPECT_EQ(seen, expected) << "seed " << seed;
  }
}

TEST(StarTour, KeepsItsDirectionAndItsFirstCluster) {
  const VoxelGrid grid(Isometry3d::Identity(), {100.0, 100.0, 20.0}, 5.0);
  const std::vector<Vector3d> places = {{30, 50, 10}, {70, 50, 10}, {72, 52, 10}, {28, 48, 10}};
  const Vector3d here(50, 50, 10), to_the_right(2, 0, 0), none = Vector3d::Zero();
  const auto right = hierarchical_tour(grid, here, to_the_right, places, std::nullopt, {}, {});
  EXPECT_GT(right.first_cluster_W.x(), 60.0);
  const auto left = hierarchical_tour(grid, here, -to_the_right, places, std::nullopt, {}, {});
  EXPECT_LT(left.first_cluster_W.x(), 40.0);
  const auto again = hierarchical_tour(grid, here, none, places, right.first_cluster_W, {}, {});
  EXPECT_GT(again.first_cluster_W.x(), 60.0) << "it keeps the first cluster of the last tour";
  const auto elsewhere = hierarchical_tour(grid, here, none, places, std::nullopt, {{29, 49, 10}}, {});
  EXPECT_GT(elsewhere.first_cluster_W.x(), 60.0) << "another UAV works on the left";
  EXPECT_TRUE(hierarchical_tour(grid, here, none, {}, std::nullopt, {}, {}).visits.empty());
}

TEST(StarTour, VisitsEveryPlaceOnce) {
  const VoxelGrid grid(Isometry3d::Identity(), {100.0, 100.0, 20.0}, 5.0);
  std::vector<Vector3d> places;
  for (int i = 0; i < 40; ++i) places.emplace_back(10.0 + 37 * i % 80, 10.0 + 53 * i % 80, 10.0);
  StarTourConfig config;
  auto visits = hierarchical_tour(grid, {0, 0, 10}, Vector3d::Zero(), places, std::nullopt, {}, config).visits;
  const Vector3d first = places[visits.front()];
  EXPECT_LT((first - Vector3d(0, 0, 10)).norm(), 60.0);
  std::ranges::sort(visits);
  ASSERT_EQ(visits.size(), places.size());
  for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i], i);
}

TEST(StarExplorer, GoalsAreAtTheFrontierInTheBox) {
  VoxelGrid grid(Isometry3d(Eigen::Translation3d(-20.0, -20.0, 0.0)), {40.0, 40.0, 24.0}, 2.0);
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    if (grid.centre_W(id).x() < 0.0) grid.raise(id, VoxelState::free);
  }
  StarExplorer explorer(StarExplorer::Config(), grid);
  explorer.look(grid, grid.take_changed(), {-15.0, 0.0, 12.0});
  const OccupancyMap map;
  const std::vector<OrientedBox> no_boxes;
  const FreeSpace space(FreeSpace::Config(), no_boxes, map);
  const StarStart start{{-15.0, 0.0, 12.0}, Vector3d::Zero(), {}};
  const OrientedBox box = make_box({0, 0, 12}, {30, 30, 20});
  const auto goals = explorer.tour(grid, space, box, start, 0);
  ASSERT_FALSE(goals.empty());
  for (const StarGoal& goal : goals) {
    EXPECT_NEAR(goal.middle_W.x(), -1.0, 0.1) << "on the rim of what is known";
    EXPECT_TRUE(explorer.open(goal));
  }
  EXPECT_TRUE(explorer.tour(grid, space, make_box({-15, 0, 12}, {4, 4, 4}), start, 0).empty())
      << "no frontier is open there";
  for (const StarGoal& goal : goals) explorer.failed(goal, 0);
  EXPECT_LT(explorer.tour(grid, space, box, start, 1).size(), goals.size());
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) grid.raise(id, VoxelState::free);
  explorer.look(grid, grid.take_changed(), start.p_WB);
  EXPECT_FALSE(explorer.open(goals.front()));
}

/// The LiDAR looks at the same frontier 20 times, but the space behind it stays unknown.
TEST(StarExplorer, GivesUpFrontiersAfterSeveralLooks) {
  VoxelGrid grid(Isometry3d::Identity(), {20.0, 20.0, 20.0}, 2.0);
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    if (grid.centre_W(id).x() < 10.0) grid.raise(id, VoxelState::free);
  }
  StarExplorer explorer(StarExplorer::Config(), grid);
  const Vector3d here(5.0, 10.0, 10.0);
  const OccupancyMap map;
  const std::vector<OrientedBox> no_boxes;
  const FreeSpace space(FreeSpace::Config(), no_boxes, map);
  const auto goals = [&] {
    return explorer.tour(grid, space, make_box({10, 10, 10}, {20, 20, 20}), {here, {}, {}}, 0).size();
  };
  explorer.look(grid, grid.take_changed(), here);
  EXPECT_GE(goals(), 3U);
  for (int i = 1; i < 20; ++i) explorer.look(grid, grid.take_changed(), here);
  EXPECT_LT(goals(), 3U);
}

TEST(StarTalk, MessagesCarryGoalsAndInspectedSurface) {
  AgentConfig speaker, listener;
  for (AgentConfig* agent : {&speaker, &listener}) {
    agent->fleet = {{.name = "a"}, {.name = "b", .role = Role::photographer, .p_WB_start = {5.0, 0.0, 0.0}}};
  }
  listener.self = UavIndex(1);
  VoxelGrid theirs(Isometry3d::Identity(), {20.0, 20.0, 20.0}, 2.0), ours = theirs;
  theirs.raise(7, VoxelState::occupied);
  theirs.mark(7, 3);
  const OccupancyMap map;
  const std::vector<OrientedBox> boxes;
  StarTalk says({}, speaker), hears({}, listener);
  Peers of_speaker(speaker), of_listener(listener);
  of_speaker.update(0, {{node_of_uav(UavIndex{1}), {5, 0, 0}}});
  const auto input = [&](std::uint64_t k, const Peers& seen, std::span<const RadioMessage> radio) {
    return PlannerInput{k, static_cast<Tick>(20 * k), {}, {}, {}, map, boxes, seen, {}, false, 0, {}, radio};
  };
  // First `hears` reports which part of the surface it knows; then `says` sends what `hears` lacks.
  PlannerOutput request, reply;
  hears.speak(input(8, of_listener, {}), ours, {}, request);
  ASSERT_EQ(request.radio.size(), 1U);
  says.listen(input(9, of_speaker, request.radio), theirs);
  StarTalk::Word word;
  word.explored = true;
  word.box = 3;
  word.goal_W = Vector3d(1.0, 2.0, 3.0);
  says.speak(input(10, of_speaker, {}), theirs, word, reply);
  ASSERT_EQ(reply.radio.size(), 1U);
  hears.listen(input(11, of_listener, reply.radio), ours);
  EXPECT_EQ(ours.state(7), VoxelState::occupied);
  EXPECT_TRUE(ours.marked(7, 3));
  ASSERT_TRUE(hears.word(0));
  EXPECT_TRUE(hears.word(0)->explored);
  EXPECT_EQ(hears.word(0)->box, 3U);
  EXPECT_EQ(hears.goals_W(ticks(1.0)), std::vector<Vector3d>{*word.goal_W});
  EXPECT_TRUE(hears.goals_W(ticks(60.0)).empty());
}

}  // namespace
}  // namespace skein::agent
