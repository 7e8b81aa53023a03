#include "uav_agent/maps/world_voxels.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;
using Cube = WorldMap::Cube;

constexpr double kCubeEdgeM = 0.5, kVoxelM = 2.5;

WorldMap map_above_ground() { return WorldMap({.cell_m = kCubeEdgeM, .ground_m = 0.3}); }

VoxelGrid grid_of_site() { return {Isometry3d(Eigen::Translation3d(-10.0, -10.0, 0.0)), {40.0, 20.0, 20.0}, kVoxelM}; }

Vector3d middle_W(const Cube& cube) { return (cube.cast<double>() + Vector3d::Constant(0.5)) * kCubeEdgeM; }

void tell(WorldMap& map, const Cube& cube, Space space) { map.hear(cube, 0, space, kOwn + 1); }

/// A cube of the map anywhere in the grid, or just beside it.
Cube drawn_cube(std::mt19937_64& random) {
  const auto along = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  return {along(-24, 64), along(-24, 24), along(1, 44)};
}

TEST(WorldVoxels, EveryOccupiedCubeOfTheMapCountsOnceWhereItLies) {
  std::mt19937_64 random(7);
  for (int drawn = 0; drawn < 10; ++drawn) {
    WorldMap map = map_above_ground();
    VoxelGrid grid = grid_of_site();
    WorldVoxels voxels;
    std::vector<Cube> told;
    for (int update = 0; update < 5; ++update) {
      for (int i = 0; i < 40; ++i) {
        told.push_back(drawn_cube(random));
        tell(map, told.back(), Space::occupied);
      }
      voxels.update(map, grid);
    }
    const auto less = [](const Cube& a, const Cube& b) { return grid_key(a) < grid_key(b); };
    std::ranges::sort(told, less);
    told.erase(std::unique(told.begin(), told.end()), told.end());
    for (Id id = 0; id < grid.count(); ++id) {
      Vector3d sum_W = Vector3d::Zero();
      int count = 0;
      for (const Cube& cube : told) {
        if (grid.at(middle_W(cube)) != id) continue;
        sum_W += middle_W(cube);
        ++count;
      }
      ASSERT_EQ(voxels.hits(id), count);
      ASSERT_EQ(grid.state(id) == VoxelState::occupied, count > 0);
      ASSERT_EQ(voxels.surface_W(id).has_value(), count > 0);
      if (count == 0) continue;
      ASSERT_LT((*voxels.surface_W(id) - sum_W / count).norm(), 1e-9);
    }
  }
}

TEST(WorldVoxels, AVoxelIsFreeIfAllSpaceAroundItsMiddleIs) {
  WorldMap map = map_above_ground();
  VoxelGrid grid = grid_of_site();
  const Id id = *grid.at(Vector3d(0.0, 0.0, 9.0)), beside = *grid.neighbour(id, 0);
  map.set_free(grid.centre_W(id), 1.2);
  map.set_free(grid.centre_W(beside), 1.2);
  tell(map, map.cube_of(grid.centre_W(beside)), Space::occupied);
  WorldVoxels voxels;
  voxels.update(map, grid);
  EXPECT_EQ(grid.state(id), VoxelState::free);
  EXPECT_EQ(grid.state(beside), VoxelState::occupied);
  EXPECT_EQ(grid.state(*grid.neighbour(id, 1)), VoxelState::unknown);
}

TEST(WorldVoxels, ADoubtedCubeDoesNotCount) {
  WorldMap map = map_above_ground();
  VoxelGrid grid = grid_of_site();
  const Cube cube(3, 4, 20);
  tell(map, cube, Space::occupied);
  map.doubt(cube);
  WorldVoxels voxels;
  voxels.update(map, grid);
  const Id id = *grid.at(middle_W(cube));
  EXPECT_NE(grid.state(id), VoxelState::occupied);
  EXPECT_EQ(voxels.hits(id), 0);
}

TEST(WorldVoxels, AnUpdateFindsCubesThatBecameFreeOrLostTheirDoubt) {
  WorldMap map = map_above_ground();
  VoxelGrid grid = grid_of_site();
  WorldVoxels voxels;
  std::mt19937_64 random(5);
  for (int update = 0; update < 30; ++update) {
    map.set_free(middle_W(drawn_cube(random)), 2.0);
    voxels.update(map, grid);
    for (Id id = 0; id < grid.count(); ++id) {
      const bool free = map.ball_free(grid.centre_W(id), WorldVoxels::Config().around_m, 0.0);
      ASSERT_EQ(grid.state(id) == VoxelState::free, free) << id;
    }
  }
  const Cube cube(3, 4, 20);
  tell(map, cube, Space::occupied);
  map.doubt(cube);
  voxels.update(map, grid);
  const std::vector<Eigen::Vector3f> hits_W = {middle_W(cube).cast<float>()};
  map.insert({}, hits_W);                        // it was not a UAV,
  tell(map, cube + Cube(1, 0, 0), Space::free);  // and another cube of its chunk is reported
  voxels.update(map, grid);
  EXPECT_EQ(voxels.hits(*grid.at(middle_W(cube))), 1);
}

TEST(WorldVoxels, ManyLimitedUpdatesFindTheSameAsAFullOne) {
  std::mt19937_64 random(3);
  WorldMap map = map_above_ground();
  for (int i = 0; i < 60; ++i) map.set_free(middle_W(drawn_cube(random)), 3.0);
  VoxelGrid at_once = grid_of_site(), in_turns = grid_of_site();
  WorldVoxels whole, part({.max_looks = 10});
  whole.update(map, at_once);
  for (int i = 0; i < 200; ++i) part.update(map, in_turns);
  for (Id id = 0; id < at_once.count(); ++id) ASSERT_EQ(at_once.state(id), in_turns.state(id)) << id;
}

}  // namespace
}  // namespace skein::agent
