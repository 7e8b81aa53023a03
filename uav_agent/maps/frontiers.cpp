#include "uav_agent/maps/frontiers.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

Vector3d middle_of(const VoxelGrid& grid, const std::vector<Id>& cubes) {
  Vector3d sum = Vector3d::Zero();
  for (const Id id : cubes) sum += grid.centre_W(id);
  return sum / static_cast<double>(cubes.size());
}

}  // namespace

bool Frontiers::is_frontier(const VoxelGrid& grid, Id id) {
  if (grid.state(id) != VoxelState::free) return false;
  for (int face = 0; face < VoxelGrid::kFaces; ++face) {
    const auto next = grid.neighbour(id, face);
    if (next && grid.state(*next) == VoxelState::unknown) return true;
  }
  return false;
}

void Frontiers::update(const VoxelGrid& grid, const std::vector<Id>& changed) {
  const auto look = [&](Id id) {
    if (is_frontier(grid, id)) {
      cubes_.insert(id);
    } else {
      cubes_.erase(id);
    }
  };
  for (const Id id : changed) {
    look(id);
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      if (const auto next = grid.neighbour(id, face)) look(*next);
    }
  }
}

std::vector<Frontiers::Cluster> Frontiers::clusters(const VoxelGrid& grid, double max_m, std::size_t min_cubes) const {
  return clusters_of(grid, std::vector<Id>(cubes_.begin(), cubes_.end()), max_m, min_cubes);
}

std::vector<CubeCluster> clusters_of(const VoxelGrid& grid, const std::vector<Id>& cubes, double max_m,
                                     std::size_t min_cubes) {
  std::vector<CubeCluster> result;
  std::vector<bool> left(grid.count(), false);
  for (const Id id : cubes) left[id] = true;
  for (const Id first : cubes) {
    if (!left[first]) continue;
    std::vector<Id> together = {first};
    left[first] = false;
    for (std::size_t i = 0; i < together.size(); ++i) {
      grid.around(together[i], 1, [&](Id id) {
        if (!left[id]) return;
        left[id] = false;
        together.push_back(id);
      });
    }
    std::vector<std::vector<Id>> pieces;
    split_by_spread(grid, std::move(together), max_m, pieces);
    for (std::vector<Id>& piece : pieces) {
      if (piece.size() < min_cubes) continue;
      std::ranges::sort(piece);
      const Vector3d middle = middle_of(grid, piece);
      result.push_back({std::move(piece), middle});
    }
  }
  return result;
}

void split_by_spread(const VoxelGrid& grid, std::vector<Id> cubes, double max_m, std::vector<std::vector<Id>>& pieces) {
  const Vector3d middle = middle_of(grid, cubes);
  Matrix3d covariance = Matrix3d::Zero();
  for (const Id id : cubes) {
    const Vector3d d = grid.centre_W(id) - middle;
    covariance += d * d.transpose();
  }
  const Vector3d longest = Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance).eigenvectors().col(2);
  const auto along = [&](Id id) { return (grid.centre_W(id) - middle).dot(longest); };
  const auto [lo, hi] = std::ranges::minmax(cubes, {}, along);
  if (cubes.size() < 2 || along(hi) - along(lo) <= max_m) {
    pieces.push_back(std::move(cubes));
    return;
  }
  std::vector<Id> low, high;
  for (const Id id : cubes) (along(id) < 0.0 ? low : high).push_back(id);
  if (low.empty() || high.empty()) {
    pieces.push_back(std::move(cubes));
    return;
  }
  split_by_spread(grid, std::move(low), max_m, pieces);
  split_by_spread(grid, std::move(high), max_m, pieces);
}

}  // namespace skein::agent
