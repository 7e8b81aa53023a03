#include "uav_agent/maps/frontiers.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((state_ >> 33) % n);
  }

 private:
  std::uint64_t state_;
};

VoxelGrid grid_of(double edge_m) { return {Isometry3d::Identity(), Vector3d::Constant(edge_m), 1.0}; }

std::set<Id> brute_force(const VoxelGrid& grid) {
  std::set<Id> all;
  for (Id id = 0; id < grid.count(); ++id) {
    if (grid.state(id) != VoxelState::free) continue;
    const VoxelGrid::Cell c = grid.cell(id);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        VoxelGrid::Cell next = c;
        next[axis] += step;
        const auto neighbour = grid.at(next);
        if (neighbour && grid.state(*neighbour) == VoxelState::unknown) all.insert(id);
      }
    }
  }
  return all;
}

TEST(Frontiers, EqualThoseOfABruteForceSearchAfterEachUpdate) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    VoxelGrid grid = grid_of(8.0);
    Frontiers frontiers;
    Draw draw(seed);
    for (int i = 0; i < 60; ++i) {
      for (int j = 0; j < 12; ++j) {
        const Id id = static_cast<Id>(draw.below(grid.count()));
        grid.raise(id, draw.below(4) == 0 ? VoxelState::occupied : VoxelState::free);
      }
      frontiers.update(grid, grid.take_changed());
      ASSERT_EQ(frontiers.cubes(), brute_force(grid)) << "seed " << seed << ", after " << i;
    }
  }
}

TEST(Frontiers, ClustersHoldEveryCubeOnceAndAreNotTooLong) {
  VoxelGrid grid = grid_of(20.0);
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 6; ++y) grid.raise(*grid.at(VoxelGrid::Cell(x, y, 3)), VoxelState::free);
  }
  grid.raise(*grid.at(VoxelGrid::Cell(15, 15, 15)), VoxelState::free);
  Frontiers frontiers;
  frontiers.update(grid, grid.take_changed());
  const auto clusters = frontiers.clusters(grid, 7.0, 1);
  std::vector<Id> all;
  for (const auto& cluster : clusters) {
    all.insert(all.end(), cluster.cubes.begin(), cluster.cubes.end());
    EXPECT_TRUE(std::ranges::is_sorted(cluster.cubes));
    double lo = 1e9, hi = -1e9;
    for (const Id id : cluster.cubes) {
      lo = std::min(lo, grid.centre_W(id).x());
      hi = std::max(hi, grid.centre_W(id).x());
    }
    EXPECT_LE(hi - lo, 7.0);
  }
  std::ranges::sort(all);
  EXPECT_TRUE(std::ranges::equal(all, frontiers.cubes()));
  EXPECT_EQ(frontiers.clusters(grid, 7.0, 2).size(), clusters.size() - 1) << "without the cluster of one cube";
}

TEST(Frontiers, ThereAreNoneWhereNothingOrEverythingIsKnown) {
  VoxelGrid grid = grid_of(5.0);
  Frontiers frontiers;
  frontiers.update(grid, {});
  EXPECT_TRUE(frontiers.cubes().empty());
  for (Id id = 0; id < grid.count(); ++id) grid.raise(id, VoxelState::free);
  frontiers.update(grid, grid.take_changed());
  EXPECT_TRUE(frontiers.cubes().empty());
  EXPECT_TRUE(frontiers.clusters(grid, 5.0, 1).empty());
}

}  // namespace
}  // namespace skein::agent
