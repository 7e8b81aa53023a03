#include "uav_agent/maps/voxel_mapper.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

/// Of the hits that a wall through the cube would give, on a map with cells of this size: that is well known.
constexpr double kKnownShare = 0.2, kMapCellM = 0.5;

}  // namespace

void VoxelMapper::update(const OccupancyMap& map, VoxelGrid& grid) {
  hits_.resize(grid.count());
  if (map.revision() != seen_revision_) find_occupied(map, grid);
  seen_revision_ = map.revision();
  find_free(map, grid);
}

void VoxelMapper::find_occupied(const OccupancyMap& map, VoxelGrid& grid) {
  std::ranges::fill(hits_, Hits());
  OrientedBox all;
  const Vector3d first = grid.centre_W(0), last = grid.centre_W(grid.count() - 1);
  all.center = 0.5 * (first + last);
  all.R_WO.col(0) = grid.normal_W(0);
  all.R_WO.col(1) = grid.normal_W(2);
  all.R_WO.col(2) = grid.normal_W(4);
  all.size = grid.voxel_m() * grid.dims().cast<double>();
  map.visit_occupied(all, [&](const Vector3d& p_W) {
    const auto id = grid.at(p_W);
    if (!id) return;
    hits_[*id].sum_W += p_W;
    if (++hits_[*id].count == config_.min_hits) grid.raise(*id, VoxelState::occupied);
  });
}

void VoxelMapper::find_free(const OccupancyMap& map, VoxelGrid& grid) {
  std::size_t looks = 0;
  for (VoxelGrid::Id i = 0; i < grid.count() && looks < config_.max_looks; ++i) {
    const VoxelGrid::Id id = next_look_;
    next_look_ = next_look_ + 1 < grid.count() ? next_look_ + 1 : 0;
    if (grid.state(id) != VoxelState::unknown) continue;
    ++looks;
    const Vector3d centre = grid.centre_W(id);
    bool seen = map.known_free(centre, config_.rays, Evidence::rays);
    for (int face = 0; face < VoxelGrid::kFaces && seen; ++face) {
      seen = map.known_free(centre + config_.around_m * grid.normal_W(face), config_.rays, Evidence::rays);
    }
    if (seen) grid.raise(id, VoxelState::free);
  }
}

VoxelGrid VoxelMapper::hearsay(const VoxelGrid& grid) const {
  const double cells = grid.voxel_m() / kMapCellM;
  const int many = static_cast<int>(kKnownShare * cells * cells);
  VoxelGrid told = grid;
  told.forget_occupied([&](VoxelGrid::Id id) { return hits(id) >= many; });
  return told;
}

std::optional<Vector3d> VoxelMapper::surface_W(VoxelGrid::Id id) const {
  if (id >= hits_.size() || hits_[id].count == 0) return std::nullopt;
  return Vector3d(hits_[id].sum_W / hits_[id].count);
}

}  // namespace skein::agent
