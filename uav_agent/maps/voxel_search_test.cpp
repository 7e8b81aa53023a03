#include "uav_agent/maps/voxel_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

/// A grid with a share of its cubes occupied, the same each time.
VoxelGrid scattered(double share, std::uint64_t seed) {
  VoxelGrid grid(Isometry3d::Identity(), {12, 10, 8}, 1.0);
  std::uint64_t random = seed;
  for (Id id = 0; id < grid.count(); ++id) {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    const double draw = static_cast<double>(random >> 11) * 0x1.0p-53;
    if (draw < share) grid.raise(id, VoxelState::occupied);
  }
  return grid;
}

class Scattered : public testing::TestWithParam<int> {};

TEST_P(Scattered, AStarFindsWhatDijkstraSays) {
  const VoxelGrid grid = scattered(0.1 * (GetParam() % 6), static_cast<std::uint64_t>(GetParam()));
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  const auto distances = voxel_distances(grid, 0, free, 1e9);
  int reached = 0;
  for (Id to = 1; to < grid.count(); to += 17) {
    const auto path = find_voxel_path(grid, 0, to, free);
    ASSERT_EQ(path.has_value(), std::isfinite(distances[to])) << to;
    if (!path) continue;
    ++reached;
    EXPECT_EQ(path->back(), to);
    EXPECT_NEAR(voxel_path_length(grid, 0, *path), distances[to], 1e-9);
    for (const Id id : *path) EXPECT_TRUE(free(id));
  }
  EXPECT_TRUE(reached > 0 || GetParam() % 6 > 2) << "an almost empty grid";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Scattered, testing::Range(0, 24));

TEST(VoxelSearch, NoCornerIsCut) {
  VoxelGrid grid(Isometry3d::Identity(), {2, 2, 1}, 1.0);
  grid.raise(1, VoxelState::occupied);
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  EXPECT_EQ(find_voxel_path(grid, 0, 3, free), (std::vector<Id>{2, 3}));
}

TEST(VoxelSearch, AWeightMakesItFasterAndAtMostSoMuchLonger) {
  const VoxelGrid grid = scattered(0.3, 5);
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  const auto distances = voxel_distances(grid, 0, free, 1e9);
  for (Id to = 1; to < grid.count(); to += 13) {
    const auto path = find_voxel_path(grid, 0, to, free, {.heuristic_weight = 1.5});
    EXPECT_TRUE(!path || voxel_path_length(grid, 0, *path) <= 1.5 * distances[to] + 1e-9);
  }
}

TEST(VoxelSearch, EffortIsBounded) {
  const VoxelGrid grid = scattered(0.0, 1);
  int asked = 0;
  const Passable free = [&](Id) {
    ++asked;
    return true;
  };
  EXPECT_FALSE(find_voxel_path(grid, 0, grid.count() - 1, free, {.max_expansions = 3}));
  EXPECT_LE(asked, 100);
  EXPECT_EQ(find_voxel_path(grid, 7, 7, free), std::vector<Id>());
}

}  // namespace
}  // namespace skein::agent
