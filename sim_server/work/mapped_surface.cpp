#include "sim_server/work/mapped_surface.hpp"

namespace skein::sim {
namespace {

Eigen::Vector3i cell_at(const Eigen::Vector3f& p_W) { return (p_W / MappedSurface::kNear).array().floor().cast<int>(); }

}  // namespace

MappedSurface::MappedSurface(const std::vector<InterestPoint>& points) : points_(points) {
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3i middle = cell_at(points[i].p_W);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) near_[cell_of(middle + Eigen::Vector3i(x, y, z))].push_back(i);
      }
    }
  }
}

std::uint64_t MappedSurface::cell_of(const Eigen::Vector3i& cell) {
  constexpr int kHalf = 1 << 20;  // cells in each direction
  std::uint64_t number = 0;
  for (const int index : cell) number = (number << 21U) | static_cast<std::uint64_t>((index + kHalf) & (2 * kHalf - 1));
  return number;
}

std::vector<bool> MappedSurface::shown_by(std::span<const Eigen::Vector3f> hits_W) const {
  std::vector<bool> shown(points_.size(), false);
  for (const Eigen::Vector3f& hit : hits_W) {
    const auto found = near_.find(cell_of(cell_at(hit)));
    if (found == near_.end()) continue;
    for (const std::uint32_t i : found->second) {
      if (!shown[i] && (points_[i].p_W - hit).squaredNorm() <= kNear * kNear) shown[i] = true;
    }
  }
  return shown;
}

}  // namespace skein::sim
