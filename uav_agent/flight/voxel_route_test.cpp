#include "uav_agent/flight/voxel_route.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

/// 50 x 50 x 20 m of cubes of 5 m with a wall across at x = 25, open at y > 40.
class VoxelRoute : public testing::Test {
 protected:
  VoxelRoute() {
    std::vector<Eigen::Vector3f> hits;
    for (float y = 0.2F; y < 40.0F; y += 0.4F) {
      for (float z = 0.5F; z < 20.0F; z += 0.4F) hits.emplace_back(27.0F, y, z);
    }
    map_.insert(hits, std::nullopt);
    for (const Eigen::Vector3f& hit : hits) grid_.raise(*grid_.at(Vector3d(hit.cast<double>())), VoxelState::occupied);
  }
  FreeSpace space() const { return {FreeSpace::Config(), no_boxes_, map_}; }

  const std::vector<OrientedBox> no_boxes_;
  OccupancyMap map_;
  VoxelGrid grid_{Isometry3d::Identity(), {50.0, 50.0, 20.0}, 5.0};
  const Vector3d here_{7.0, 8.0, 9.0}, there_{44.0, 6.0, 9.0};
};

TEST_F(VoxelRoute, IsStraightWhereNothingIsInTheWay) {
  const Vector3d aside(8.0, 40.0, 12.0);
  EXPECT_EQ(find_voxel_route(grid_, space(), here_, aside), std::vector<Vector3d>{aside});
}

TEST_F(VoxelRoute, LeadsAroundTheWallOnLegsThatAreFree) {
  const auto route = find_voxel_route(grid_, space(), here_, there_);
  ASSERT_TRUE(route);
  EXPECT_EQ(route->back(), there_);
  EXPECT_LE(route->size(), 5U) << "the route is shortened";
  Vector3d at = here_;
  for (const Vector3d& corner : *route) {
    EXPECT_TRUE(space().segment_free(at, corner));
    at = corner;
  }
}

TEST_F(VoxelRoute, ClaimedCubesAreNotEntered) {
  std::set<Id> claimed;
  for (int y = 8; y < 10; ++y) {
    for (int z = 0; z < 3; ++z) claimed.insert(*grid_.at(VoxelGrid::Cell(5, y, z)));
  }
  const auto route = find_voxel_route(grid_, space(), here_, there_, claimed);
  ASSERT_TRUE(route) << "the route leads above the claimed cubes";
  Vector3d at = here_;
  for (const Vector3d& corner : *route) {
    grid_.along(at, corner, [&](Id id) {
      EXPECT_FALSE(claimed.contains(id));
      return true;
    });
    at = corner;
  }
  claimed = {*grid_.at(there_)};
  EXPECT_FALSE(find_voxel_route(grid_, space(), here_, there_, claimed)) << "the goal itself is claimed";
  claimed = {*grid_.at(here_)};
  EXPECT_TRUE(find_voxel_route(grid_, space(), here_, there_, claimed)) << "the UAV is in this cube already";
}

/// Some cubes are occupied only according to the grid, because other UAVs reported them. The route enters no such cube
/// but that of the goal, to get near to the goal.
TEST_F(VoxelRoute, EntersNoOccupiedCubeButThatOfTheGoal) {
  int found = 0;
  for (std::uint64_t world = 0; world < 60; ++world) {
    RandomStream random(world, "voxel_route", 0);
    VoxelGrid grid = grid_;
    const Id from = *grid.at(here_), to = *grid.at(there_);
    for (Id id = 0; id < grid.count(); ++id) {
      if (random.uniform() < 0.15 && id != from && id != to) grid.raise(id, VoxelState::occupied);
    }
    if (world % 2 == 0) grid.raise(to, VoxelState::occupied);
    const auto route = find_voxel_route(grid, space(), here_, there_);
    if (!route) continue;
    ++found;
    EXPECT_EQ(route->back(), there_);
    Vector3d at = here_;
    for (const Vector3d& corner : *route) {
      grid.along(at, corner, [&](Id id) {
        EXPECT_TRUE(id == from || id == to || grid.state(id) != VoxelState::occupied) << world;
        return true;
      });
      at = corner;
    }
  }
  EXPECT_GT(found, 20);
  VoxelGrid grid = grid_;
  grid.raise(*grid.at(there_), VoxelState::occupied);
  EXPECT_TRUE(find_voxel_route(grid, space(), here_, there_));
}

}  // namespace
}  // namespace skein::agent
