#include "uav_agent/maps/world_voxels.hpp"

namespace skein::agent {

void WorldVoxels::update(const WorldMap& map, VoxelGrid& grid) {
  hits_.resize(grid.count());
  find_occupied(map, grid);
  find_free(map, grid);
}

void WorldVoxels::find_occupied(const WorldMap& map, VoxelGrid& grid) {
  for (const WorldMap::Cube& region : map.regions()) {
    std::uint64_t& seen = regions_[grid_key(region)];
    if (map.region_changed_at(region) == seen) continue;
    seen = map.region_changed_at(region);
    for (int i = 0; i < WorldMap::kRegionChunks; ++i) count(map, WorldMap::chunk_of(region, i), grid);
  }
}

void WorldVoxels::count(const WorldMap& map, const WorldMap::Cube& chunk, VoxelGrid& grid) {
  const std::uint64_t changed_at = map.changed_at(chunk);
  if (changed_at == 0) return;
  Counted& counted = chunks_[grid_key(chunk)];
  if (counted.changed_at == changed_at) return;
  counted.changed_at = changed_at;
  WorldMap::Chunk known;
  map.read(chunk, known);
  for (std::size_t place = 0; place < known.size(); ++place) {
    if (known[place].space != Space::occupied || counted.cubes[place]) continue;
    const WorldMap::Cube cube = WorldMap::kChunk * chunk + MapLevel::in_block(place);
    if (map.doubted(cube)) continue;
    counted.cubes.set(place);
    const Vector3d p_W = map.middle_W(cube);
    const auto id = grid.at(p_W);
    if (!id) continue;
    hits_[*id].sum_W += p_W;
    ++hits_[*id].count;
    grid.raise(*id, VoxelState::occupied);
  }
}

void WorldVoxels::find_free(const WorldMap& map, VoxelGrid& grid) {
  std::size_t looks = 0;
  for (VoxelGrid::Id i = 0; i < grid.count() && looks < config_.max_looks; ++i) {
    const VoxelGrid::Id id = next_look_;
    next_look_ = next_look_ + 1 < grid.count() ? next_look_ + 1 : 0;
    if (grid.state(id) != VoxelState::unknown) continue;
    ++looks;
    if (map.ball_free(grid.centre_W(id), config_.around_m, 0.0)) grid.raise(id, VoxelState::free);
  }
}

std::optional<Vector3d> WorldVoxels::surface_W(VoxelGrid::Id id) const {
  if (hits(id) == 0) return std::nullopt;
  return Vector3d(hits_[id].sum_W / hits_[id].count);
}

}  // namespace skein::agent
