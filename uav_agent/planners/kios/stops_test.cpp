// Waypoints of KIOS: where they are, which faces they are for, and which UAV visits them.
#include "uav_agent/planners/kios/stops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "uav_agent/flight/body_fit.hpp"
#include "uav_agent/testing/test_world.hpp"

namespace skein::agent {
namespace {

/// 60 x 20 x 20 m, cubes of 5 m.
VoxelGrid wide_grid() { return {Isometry3d::Identity(), {60.0, 20.0, 20.0}, 5.0}; }

/// A map of all beams with structure that another UAV reported, a grid of this map, and a box.
struct MappedSite {
  VoxelGrid grid{Isometry3d::Identity(), {25.0, 25.0, 25.0}, 5.0};
  WorldMap map{WorldMap::Config()};
  WorldVoxels voxels;
  OccupancyMap hits;
  std::vector<OrientedBox> boxes = {make_box({12.5, 12.5, 12.5}, {5.0, 5.0, 5.0})};

  void tell(const Vector3d& p_W, Space space = Space::occupied) { map.hear(map.cube_of(p_W), 0, space, kOwn + 1); }
  FreeSpace space() const {
    FreeSpace::Config config;
    config.world = &map;
    return {config, boxes, hits};
  }
  KiosStops::Open open(const KiosStops& stops, Tick now = 0) {
    voxels.update(map, grid);
    return stops.open_stops(grid, voxels, space(), boxes, now);
  }
};

/// One occupied cube.
struct LoneCube : MappedSite {
  VoxelGrid::Id cube = *grid.at(Vector3d(12.5, 12.5, 12.5));

  LoneCube() { tell({12.4, 12.4, 12.4}); }
};

TEST(KiosStops, EveryExposedFaceHasAStopThatLooksAtIt) {
  LoneCube world;
  const KiosStops stops{KiosStops::Config()};
  const auto open = world.open(stops);
  ASSERT_EQ(open.stops.size(), 6U);
  for (const KiosStop& stop : open.stops) {
    EXPECT_EQ(stop.id / VoxelGrid::kFaces, world.cube);
    EXPECT_NEAR((stop.p_WB - stop.surface_W).dot(stop.out_W), 5.0, 0.5) << "the stop is in the middle of the next cube";
  }
}

TEST(KiosStops, PhotographedCoveredAndFailedFacesAreNotOpen) {
  LoneCube world;
  KiosStops stops{KiosStops::Config()};
  world.grid.mark(world.cube, 2);
  world.tell(world.grid.centre_W(*world.grid.neighbour(world.cube, 0)));
  world.boxes = {make_box({12.5, 12.5, 12.5}, {4.0, 5.0, 5.0})};  // without the neighbour
  stops.failed(VoxelGrid::kFaces * world.cube + 4, 0);
  EXPECT_EQ(world.open(stops).stops.size(), 3U);
  EXPECT_EQ(world.open(stops, ticks(60.0)).stops.size(), 4U) << "the failed face is tried again";
}

TEST(KiosStops, ACubeWithFewMappedCellsIsNotOpen) {
  LoneCube world;
  const KiosStops stops{KiosStops::Config{.min_hits = 3}};
  EXPECT_TRUE(world.open(stops).stops.empty());
  world.tell({12.4, 12.4, 11.4});
  EXPECT_TRUE(world.open(stops).stops.empty());
  world.tell({12.4, 12.4, 10.4});
  EXPECT_EQ(world.open(stops).stops.size(), 6U);
}

/// For random maps: each exposed face with its surface in a box has at most one stop. Every stop is in free space, in
/// front of its face, and at a distance at which pictures are sharp.
TEST(KiosStops, AreFreeAndInFrontOfTheirFacesOnAnyMap) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> along(0.0, 25.0);
  for (int drawn = 0; drawn < 30; ++drawn) {
    MappedSite world;
    world.boxes = {make_box({12.5, 12.5, 12.5}, {14.0, 9.0, 20.0}, 0.3)};
    for (int i = 0; i < 20 + 2 * drawn; ++i) world.tell({along(random), along(random), along(random)});
    const KiosStops::Config config;
    const auto open = world.open(KiosStops{config});
    const FreeSpace space = world.space();
    std::size_t exposed = 0;
    for (VoxelGrid::Id id = 0; id < world.grid.count(); ++id) {
      const auto surface_W = world.voxels.surface_W(id);
      if (!surface_W || !world.boxes.front().contains(*surface_W, 0.5)) continue;
      for (int face = 0; face < VoxelGrid::kFaces; ++face) {
        const auto outside = world.grid.neighbour(id, face);
        exposed += outside && world.voxels.hits(*outside) == 0 ? 1U : 0U;
      }
    }
    std::set<std::uint32_t> ids;
    for (const KiosStop& stop : open.stops) {
      ids.insert(stop.id);
      EXPECT_TRUE(space.free(stop.p_WB));
      EXPECT_EQ(world.voxels.surface_W(stop.id / VoxelGrid::kFaces), stop.surface_W);
      const Vector3d off_W = stop.p_WB - stop.surface_W;
      EXPECT_GT(off_W.dot(stop.out_W), space.config().clearance_m);
      EXPECT_LT(off_W.dot(stop.out_W), config.standoff_ratio * config.sharp_m + 1e-9);
    }
    EXPECT_EQ(ids.size(), open.stops.size());
    EXPECT_EQ(open.stops.size() + open.out_of_reach, exposed);
    EXPECT_GT(exposed, 0U);
  }
}

TEST(KiosStops, AStopLiesAsideIfStructureStandsInFrontOfItsFace) {
  LoneCube world;
  world.tell({17.4, 12.4, 12.4});
  world.boxes = {make_box({12.5, 12.5, 12.5}, {4.0, 5.0, 5.0})};
  world.tell({15.3, 12.4, 12.4});  // in the same cube as the one before
  const KiosStops stops{KiosStops::Config{.min_hits = 3}};
  world.tell({12.4, 13.4, 12.4});
  world.tell({12.4, 11.4, 12.4});
  const auto open = world.open(stops);
  ASSERT_EQ(open.stops.size(), 6U);
  for (const KiosStop& stop : open.stops) {
    if (stop.id % VoxelGrid::kFaces == 0) {
      EXPECT_GT((stop.p_WB - stop.surface_W).tail<2>().norm(), 1.0);
    }
    EXPECT_TRUE(world.space().free(stop.p_WB));
  }
}

/// Here, paths may lead through unknown space. A stop still needs space that was seen to be free, and it is proved if a
/// body fits there.
TEST(KiosStops, NoStopIsInUnseenSpaceAndAStopIsProvedOnlyIfABodyFits) {
  LoneCube world;
  const Vector3d in_front_W(17.5, 12.5, 12.5), behind_W(7.5, 12.5, 12.5);
  world.map.set_free(in_front_W, 2.6);
  world.map.set_free(behind_W, 0.5);
  BodyFit fit(1.0, 0.0);
  fit.update(world.map, 0);
  FreeSpace::Config config;
  config.world = &world.map;
  config.fit = &fit;
  config.unknown_cost = 1.5;
  world.voxels.update(world.map, world.grid);
  for (const bool proved_only : {false, true}) {
    config.proved_only = proved_only;
    const auto open = KiosStops{KiosStops::Config()}.open_stops(
        world.grid, world.voxels, FreeSpace(config, world.boxes, world.hits), world.boxes, 0);
    ASSERT_EQ(open.stops.size(), proved_only ? 1U : 2U);
    EXPECT_EQ(open.out_of_reach, 6U - open.stops.size());
    for (const KiosStop& stop : open.stops) EXPECT_EQ(stop.proved, stop.out_W == Vector3d::UnitX());
  }
}

TEST(KiosStops, ToursVisitStopsBehindStructureLast) {
  VoxelGrid grid = wide_grid();
  for (int z = 0; z < 4; ++z) grid.raise(*grid.at(VoxelGrid::Cell(6, 1, z)), VoxelState::occupied);
  std::vector<KiosStop> stops(2);
  stops[0].p_WB = {38.0, 7.5, 10.0};  // nearer, but behind the structure
  stops[1].p_WB = {17.0, 7.5, 10.0};
  const std::vector<KiosAgent> alone = {{{28.0, 7.5, 10.0}, 0.0}};
  const KiosStops share{KiosStops::Config()};
  EXPECT_EQ(share.own_tour(stops, alone, 0, grid).front(), 1U);
  EXPECT_EQ(share.own_tour(stops, alone, 0, wide_grid()).front(), 0U);
}

TEST(KiosStops, UavsInSightShareTheStops) {
  std::vector<KiosStop> stops;
  for (int i = 0; i < 40; ++i) {
    KiosStop stop;
    stop.id = static_cast<std::uint32_t>(i);
    stop.p_WB = {5.0 * i, 0.0, 10.0};
    stops.push_back(stop);
  }
  const std::vector<KiosAgent> agents = {{{0.0, 0.0, 10.0}, 0.0}, {{195.0, 0.0, 10.0}, 0.0}};
  const KiosStops share{KiosStops::Config()};
  const VoxelGrid grid = wide_grid();
  const auto left = share.own_tour(stops, agents, 0, grid), right = share.own_tour(stops, agents, 1, grid);
  EXPECT_EQ(left.size() + right.size(), 40U);
  EXPECT_NEAR(static_cast<double>(left.size()), 20.0, 2.0);
  for (const std::size_t i : left) EXPECT_EQ(std::ranges::count(right, i), 0);
  EXPECT_EQ(left.front(), 0U);
  EXPECT_EQ(right.front(), 39U);
  EXPECT_EQ(share.own_tour(stops, {agents[0]}, 0, grid).size(), 40U) << "no other UAV is in sight: all of them";
}

}  // namespace
}  // namespace skein::agent
