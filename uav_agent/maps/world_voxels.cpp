#include "uav_agent/maps/world_voxels.hpp"

#include <algorithm>
#include <bit>

namespace skein::agent {

void WorldVoxels::update(const WorldMap& map, VoxelGrid& grid) {
  hits_.resize(grid.count());
  look_again_.resize(grid.count(), 1);
  find_occupied(map, grid);
  find_free(map, grid);
}

void WorldVoxels::find_occupied(const WorldMap& map, VoxelGrid& grid) {
  for (const WorldMap::Cube& region : map.regions()) {
    std::uint64_t& seen = regions_[grid_key(region)];
    if (map.region_changed_at(region) == seen) continue;
    seen = map.region_changed_at(region);
    const WorldMap::ChunksChangedAt& changed_at = map.chunks_changed_at(region);
    for (int i = 0; i < WorldMap::kRegionChunks; ++i) {
      count(map, WorldMap::chunk_of(region, i), changed_at[static_cast<std::size_t>(i)], grid);
    }
  }
}

void WorldVoxels::note(const WorldMap& map, const WorldMap::Cube& chunk, const VoxelGrid& grid) {
  const double cell_m = map.config().cell_m, edge_m = WorldMap::kChunk * cell_m;
  const Vector3d middle_W = (chunk.cast<double>() + Vector3d::Constant(0.5)) * edge_m;
  const auto [low, high] = grid.cells_within(middle_W, 0.5 * edge_m + config_.around_m + cell_m);
  if ((low.array() > high.array()).any()) return;
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      const auto first = look_again_.begin() + *grid.at(VoxelGrid::Cell(low.x(), y, z));
      std::fill(first, first + (high.x() - low.x() + 1), 1);
    }
  }
}

/// Reads the chunk only if a cube of it may have become occupied, or if a doubt may have ended.
void WorldVoxels::count(const WorldMap& map, const WorldMap::Cube& chunk, std::uint64_t changed_at, VoxelGrid& grid) {
  if (changed_at == 0) return;
  Counted& counted = chunks_[grid_key(chunk)];
  if (counted.changed_at == changed_at) return;
  counted.changed_at = changed_at;
  note(map, chunk, grid);
  const std::uint64_t structure_changed_at = map.structure_changed_at(chunk);
  if (counted.structure_changed_at == structure_changed_at && !counted.any_in_doubt) return;
  counted.structure_changed_at = structure_changed_at;
  counted.any_in_doubt = false;
  const CellRows occupied = map.rows(chunk, Space::occupied);
  for (std::size_t row = 0; row < occupied.size(); ++row) {
    for (unsigned left = occupied[row]; left != 0; left &= left - 1) {
      const std::size_t place = row * kRowCells + static_cast<std::size_t>(std::countr_zero(left));
      if (!counted.cubes[place]) count(map, chunk, place, counted, grid);
    }
  }
}

void WorldVoxels::count(const WorldMap& map, const WorldMap::Cube& chunk, std::size_t place, Counted& counted,
                        VoxelGrid& grid) {
  const WorldMap::Cube cube = WorldMap::kChunk * chunk + MapLevel::in_block(place);
  if (map.doubted(cube)) {
    counted.any_in_doubt = true;
    return;
  }
  counted.cubes.set(place);
  const Vector3d p_W = map.middle_W(cube);
  const auto id = grid.at(p_W);
  if (!id) return;
  hits_[*id].sum_W += p_W;
  ++hits_[*id].count;
  grid.raise(*id, VoxelState::occupied);
}

void WorldVoxels::find_free(const WorldMap& map, VoxelGrid& grid) {
  std::size_t looks = 0;
  for (VoxelGrid::Id i = 0; i < grid.count() && looks < config_.max_looks; ++i) {
    const VoxelGrid::Id id = next_look_;
    next_look_ = next_look_ + 1 < grid.count() ? next_look_ + 1 : 0;
    if (grid.state(id) != VoxelState::unknown) continue;
    ++looks;
    if (look_again_[id] == 0) continue;
    look_again_[id] = 0;
    if (map.ball_free(grid.centre_W(id), config_.around_m, 0.0)) grid.raise(id, VoxelState::free);
  }
}

std::optional<Vector3d> WorldVoxels::surface_W(VoxelGrid::Id id) const {
  if (hits(id) == 0) return std::nullopt;
  return Vector3d(hits_[id].sum_W / hits_[id].count);
}

}  // namespace skein::agent
