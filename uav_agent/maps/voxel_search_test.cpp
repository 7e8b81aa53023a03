#include "uav_agent/maps/voxel_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Length of the shortest path from cube 0 to each other: shortens lengths by single steps until none gets shorter.
std::vector<double> distances_in(const VoxelGrid& grid, const Passable& free) {
  std::vector<double> distances(grid.count(), std::numeric_limits<double>::infinity());
  distances[0] = 0.0;
  const auto may_step = [&](const VoxelGrid::Cell& from, const VoxelGrid::Cell& to) {
    for (int corner = 1; corner < 8; ++corner) {
      const VoxelGrid::Cell part(corner & 1 ? to.x() : from.x(), corner & 2 ? to.y() : from.y(),
                                 corner & 4 ? to.z() : from.z());
      if (part != from && !free(*grid.at(part))) return false;
    }
    return true;
  };
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (Id from = 0; from < grid.count(); ++from) {
      if (!std::isfinite(distances[from])) continue;
      for (int i = 0; i < 27; ++i) {
        const VoxelGrid::Cell step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), c = grid.cell(from);
        const auto to = grid.at(VoxelGrid::Cell(c + step));
        if (!to || !may_step(c, grid.cell(*to))) continue;
        const double distance = distances[from] + (grid.centre_W(*to) - grid.centre_W(from)).norm();
        if (distance >= distances[*to] - 1e-12) continue;
        distances[*to] = distance;
        shorter = true;
      }
    }
  }
  return distances;
}

/// Length of the path along the cubes' centres [m].
double length_of(const VoxelGrid& grid, Id from, const std::vector<Id>& path) {
  double length = 0.0;
  for (const Id id : path) {
    length += (grid.centre_W(id) - grid.centre_W(from)).norm();
    from = id;
  }
  return length;
}

class Scattered : public testing::TestWithParam<int> {};

TEST_P(Scattered, AStarFindsTheShortestWays) {
  const VoxelGrid grid = scattered(0.1 * (GetParam() % 6), static_cast<std::uint64_t>(GetParam()));
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  const auto distances = distances_in(grid, free);
  int reached = 0;
  for (Id to = 1; to < grid.count(); to += 17) {
    const auto path = find_voxel_path(grid, 0, to, free);
    ASSERT_EQ(path.has_value(), std::isfinite(distances[to])) << to;
    if (!path) continue;
    ++reached;
    EXPECT_EQ(path->back(), to);
    EXPECT_NEAR(length_of(grid, 0, *path), distances[to], 1e-9);
    for (const Id id : *path) EXPECT_TRUE(free(id));
  }
  EXPECT_TRUE(reached > 0 || GetParam() % 6 > 2) << "in an almost empty grid, cubes can be reached";
}

TEST_P(Scattered, CubesInReachAreThoseWithAPath) {
  const VoxelGrid grid = scattered(0.1 * (GetParam() % 6), static_cast<std::uint64_t>(GetParam()));
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  const auto distances = distances_in(grid, free);
  const auto reached = voxels_in_reach(grid, 0, free);
  ASSERT_TRUE(reached.has_value());
  for (Id to = 0; to < grid.count(); ++to) EXPECT_EQ((*reached)[to], std::isfinite(distances[to])) << to;
  const auto count = static_cast<std::size_t>(std::ranges::count(*reached, true));
  EXPECT_TRUE(voxels_in_reach(grid, 0, free, count).has_value());
  EXPECT_FALSE(voxels_in_reach(grid, 0, free, count - 1).has_value());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Scattered, testing::Range(0, 24));

TEST(VoxelSearch, NoCornerIsCut) {
  VoxelGrid grid(Isometry3d::Identity(), {2, 2, 1}, 1.0);
  grid.raise(1, VoxelState::occupied);
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  EXPECT_EQ(find_voxel_path(grid, 0, 3, free), (std::vector<Id>{2, 3}));
}

TEST(VoxelSearch, AWeightMakesPathsAtMostThatMuchLonger) {
  const VoxelGrid grid = scattered(0.3, 5);
  const Passable free = [&](Id id) { return grid.state(id) != VoxelState::occupied; };
  const auto distances = distances_in(grid, free);
  for (Id to = 1; to < grid.count(); to += 13) {
    const auto path = find_voxel_path(grid, 0, to, free, {.heuristic_weight = 1.5});
    EXPECT_TRUE(!path || length_of(grid, 0, *path) <= 1.5 * distances[to] + 1e-9);
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
