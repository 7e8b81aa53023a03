#include "uav_agent/planning/viewpoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/math/euler.hpp"

namespace skein::agent {

std::vector<Vector3d> ring_around(const Vector3d& target_W, const RingConfig& config) {
  std::vector<Vector3d> places;
  for (int ring = 0; ring < config.rings; ++ring) {
    const double share = config.rings > 1 ? static_cast<double>(ring) / (config.rings - 1) : 0.0;
    const double radius = config.inner_m + share * (config.outer_m - config.inner_m);
    for (const double height : config.heights_m) {
      for (int i = 0; i < config.directions; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / config.directions;
        places.push_back(target_W + Vector3d(radius * std::cos(turn), radius * std::sin(turn), height));
      }
    }
  }
  return places;
}

std::vector<BoxView> rings_around(const std::vector<OrientedBox>& boxes, double standoff_m, double ring_step_m) {
  std::vector<BoxView> views;
  for (const OrientedBox& box : boxes) {
    const Vector3d half = 0.5 * box.size;
    const int rings = std::max(1, static_cast<int>(box.size.z() / ring_step_m));
    for (int ring = 0; ring < rings; ++ring) {
      const double z = (0.5 - (ring + 0.5) / rings) * box.size.z();
      for (const auto& [x, y] : {std::pair(1, 1), std::pair(-1, 1), std::pair(-1, -1), std::pair(1, -1)}) {
        const Vector3d edge_O(x * half.x(), y * half.y(), z);
        const Vector3d away_O(x * standoff_m, y * standoff_m, 0.0);
        views.push_back({box.center + box.R_WO * (edge_O + away_O), box.center + box.R_WO * edge_O});
      }
    }
  }
  return views;
}

std::vector<std::size_t> visible_targets(const VoxelGrid& grid, const Vector3d& from_W, double yaw, double pitch,
                                         const std::vector<Vector3d>& targets_W, const ViewLimits& limits) {
  const Matrix3d R_CW = (rotation_z(yaw) * rotation_y(pitch)).transpose();
  std::vector<std::size_t> visible;
  for (std::size_t i = 0; i < targets_W.size(); ++i) {
    const Vector3d to_target = targets_W[i] - from_W;
    if (to_target.norm() > limits.range_m) continue;
    const Vector3d p_C = R_CW * to_target;
    const double aside = std::abs(std::atan2(p_C.y(), p_C.x())), above = std::abs(std::atan2(p_C.z(), p_C.x()));
    if (aside > limits.half_width || above > limits.half_height) continue;
    if (grid.sees(from_W, targets_W[i])) visible.push_back(i);
  }
  return visible;
}

std::vector<std::vector<std::size_t>> visibility_clusters(const VoxelGrid& grid, const std::vector<Vector3d>& places_W,
                                                          double radius_m) {
  std::vector<std::vector<std::size_t>> clusters;
  std::vector<bool> taken(places_W.size(), false);
  for (std::size_t first = 0; first < places_W.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::size_t> cluster = {first};
    for (std::size_t other = first + 1; other < places_W.size(); ++other) {
      const bool near = !taken[other] && (places_W[other] - places_W[first]).norm() <= radius_m;
      if (!near || !grid.sees(places_W[first], places_W[other])) continue;
      taken[other] = true;
      cluster.push_back(other);
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

std::vector<std::size_t> shortest_through(const Vector3d& from_W, const std::vector<std::vector<Vector3d>>& options) {
  std::vector<Vector3d> before = {from_W};
  std::vector<double> length = {0.0};
  std::vector<std::vector<std::size_t>> came_from;
  for (const std::vector<Vector3d>& layer : options) {
    std::vector<double> best(layer.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> parent(layer.size(), 0);
    for (std::size_t i = 0; i < layer.size(); ++i) {
      for (std::size_t j = 0; j < before.size(); ++j) {
        const double way = length[j] + (layer[i] - before[j]).norm();
        if (way >= best[i]) continue;
        best[i] = way;
        parent[i] = j;
      }
    }
    before = layer;
    length = std::move(best);
    came_from.push_back(std::move(parent));
  }
  std::vector<std::size_t> choice(options.size());
  auto at = static_cast<std::size_t>(std::ranges::min_element(length) - length.begin());
  for (std::size_t stop = options.size(); stop-- > 0;) {
    choice[stop] = at;
    at = came_from[stop][at];
  }
  return choice;
}

}  // namespace skein::agent
