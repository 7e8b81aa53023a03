#include "uav_agent/maps/voxel_mapper.hpp"

#include <gtest/gtest.h>

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

VoxelGrid grid_of_site() { return {Isometry3d(Eigen::Translation3d(-10.0, -10.0, 0.0)), {40.0, 20.0, 20.0}, 5.0}; }

/// A wall at x = 20, scanned from the origin.
OccupancyMap scanned_wall() {
  OccupancyMap map;
  std::vector<Eigen::Vector3f> hits;
  for (float y = -9.0F; y < 9.0F; y += 0.4F) {
    for (float z = 1.0F; z < 18.0F; z += 0.4F) hits.emplace_back(20.2F, y, z);
  }
  for (int i = 0; i < 12; ++i) map.insert(hits, Vector3d(0.0, 0.0, 8.0));
  return map;
}

TEST(VoxelMapper, HitsAreOccupiedWhatRaysPassedIsFreeTheRestUnknown) {
  const OccupancyMap map = scanned_wall();
  VoxelGrid grid = grid_of_site();
  VoxelMapper mapper;
  mapper.update(map, grid);
  EXPECT_EQ(grid.state(*grid.at(Vector3d(20.2, 0.0, 8.0))), VoxelState::occupied);
  EXPECT_EQ(grid.state(*grid.at(Vector3d(7.5, 0.0, 8.0))), VoxelState::free);
  EXPECT_EQ(grid.state(*grid.at(Vector3d(27.5, 0.0, 8.0))), VoxelState::unknown) << "behind the wall";
  for (Id id = 0; id < grid.count(); ++id) {
    const bool has_hits = mapper.surface_W(id).has_value();
    EXPECT_EQ(grid.state(id) == VoxelState::occupied, has_hits);
    if (!has_hits) continue;
    EXPECT_NEAR(mapper.surface_W(id)->x(), 20.25, 0.01) << "the middle of the map's cells";
    EXPECT_EQ(grid.at(*mapper.surface_W(id)), id);
  }
}

TEST(VoxelMapper, AFewHitsMayBeTooFew) {
  OccupancyMap map;
  map.insert({{1.0F, 1.0F, 8.0F}, {1.0F, 2.0F, 8.0F}}, std::nullopt);
  VoxelGrid strict = grid_of_site(), lax = grid_of_site();
  VoxelMapper({.min_hits = 3}).update(map, strict);
  VoxelMapper({.min_hits = 2}).update(map, lax);
  const Id id = *lax.at(Vector3d(1.0, 1.0, 8.0));
  EXPECT_EQ(strict.state(id), VoxelState::unknown);
  EXPECT_EQ(lax.state(id), VoxelState::occupied);
}

TEST(VoxelMapper, HearsayIsWhatItDoesNotKnowWellItself) {
  const OccupancyMap map = scanned_wall();
  VoxelGrid grid = grid_of_site();
  VoxelMapper mapper;
  mapper.update(map, grid);
  const Id seen = *grid.at(Vector3d(20.2, 0.0, 8.0)), told = *grid.at(Vector3d(27.5, 0.0, 8.0));
  const Id free = *grid.at(Vector3d(7.5, 0.0, 8.0));
  grid.raise(told, VoxelState::occupied);
  const VoxelGrid hearsay = mapper.hearsay(grid);
  EXPECT_EQ(hearsay.state(seen), VoxelState::unknown) << "a whole wall of hits";
  EXPECT_EQ(hearsay.state(told), VoxelState::occupied);
  EXPECT_EQ(hearsay.state(free), VoxelState::free);
  EXPECT_EQ(grid.state(seen), VoxelState::occupied) << "the grid that is exchanged stays";
}

TEST(VoxelMapper, LooksInTurnsFindTheSame) {
  const OccupancyMap map = scanned_wall();
  VoxelGrid at_once = grid_of_site(), in_turns = grid_of_site();
  VoxelMapper whole, part({.max_looks = 10});
  whole.update(map, at_once);
  for (int i = 0; i < 40; ++i) part.update(map, in_turns);
  for (Id id = 0; id < at_once.count(); ++id) EXPECT_EQ(at_once.state(id), in_turns.state(id)) << id;
}

}  // namespace
}  // namespace skein::agent
