#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "results/octree_file.hpp"

namespace skein::report {
namespace {

constexpr double kMostCubes = 1e6;  ///< in the axis-aligned bounding box of all boxes

/// Computes which volume of cubes lies in the boxes. A cube counts entirely if its middle is in a box.
class BoxVolume {
 public:
  explicit BoxVolume(const std::vector<results::RunBox>& boxes) : boxes_(boxes) {
    for (const results::RunBox& box : boxes) {
      const Vector3d half = box.R_WB.cwiseAbs() * (0.5 * box.size);
      extents_.emplace_back(box.center - half, box.center + half);
      all_.extend(extents_.back());
    }
    while (!all_.isEmpty() && all_.volume() > kMostCubes * std::pow(edge_m_, 3)) edge_m_ *= 2.0;
  }

  double of(const KnownCube& cube) const {
    const Vector3d highest_W = cube.lowest_W + Vector3d::Constant(cube.edge_m);
    if (!all_.intersects(Eigen::AlignedBox3d(cube.lowest_W, highest_W))) return 0.0;
    if (cube.edge_m <= edge_m_) return holds(cube.middle_W()) ? std::pow(cube.edge_m, 3) : 0.0;
    double sum = 0.0;
    const double half = 0.5 * cube.edge_m;
    for (unsigned i = 0; i < 8; ++i) {
      const Vector3d octant(i & 1U, i >> 1 & 1U, i >> 2);
      sum += of({cube.lowest_W + half * octant, half, cube.occupied});
    }
    return sum;
  }

  /// Volume of all boxes, counted in cubes of edge_m_ [m^3].
  double total() const {
    if (all_.isEmpty()) return 0.0;
    double sum = 0.0;
    const Vector3d first = (all_.min() / edge_m_).array().floor().matrix() * edge_m_;
    for (double x = first.x(); x < all_.max().x(); x += edge_m_) {
      for (double y = first.y(); y < all_.max().y(); y += edge_m_) {
        for (double z = first.z(); z < all_.max().z(); z += edge_m_) sum += of({{x, y, z}, edge_m_});
      }
    }
    return sum;
  }

 private:
  bool holds(const Vector3d& p_W) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (extents_[i].contains(p_W) && boxes_[i].holds(p_W)) return true;
    }
    return false;
  }

  const std::vector<results::RunBox>& boxes_;
  std::vector<Eigen::AlignedBox3d> extents_;
  Eigen::AlignedBox3d all_;
  double edge_m_ = 2.0;  ///< larger cubes are divided before they are counted
};

}  // namespace

std::vector<std::optional<MapFigures>> map_figures(const results::RunRecord& run) {
  std::vector<std::optional<MapFigures>> figures(run.uavs.size());
  const BoxVolume boxes(run.boxes);
  std::optional<double> whole;
  for (std::size_t i = 0; i < std::min(figures.size(), run.maps.size()); ++i) {
    if (run.maps[i].empty()) continue;
    if (!whole) whole = boxes.total();
    MapFigures& map = figures[i].emplace();
    double known = 0.0;
    results::visit_octree_file(run.maps[i], [&](const KnownCube& cube) {
      (cube.occupied ? map.occupied_m3 : map.free_m3) += std::pow(cube.edge_m, 3);
      known += boxes.of(cube);
    });
    if (*whole > 0.0) map.known_share = known / *whole;
  }
  return figures;
}

}  // namespace skein::report
