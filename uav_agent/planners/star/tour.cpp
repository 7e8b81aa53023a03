#include "uav_agent/planners/star/tour.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/planning/tours.hpp"
#include "uav_agent/planning/viewpoints.hpp"

namespace skein::agent {
namespace {

constexpr double kMovingMps = 0.3;    ///< a slower UAV has no direction to keep; chosen
constexpr double kSamePlaceM = 1e-6;  ///< numeric: a shorter way has no direction

double turn_between(const Vector3d& v_W, const Vector3d& way_W) {
  if (v_W.norm() < kMovingMps || way_W.norm() < kSamePlaceM) return 0.0;
  return std::acos(std::clamp(v_W.normalized().dot(way_W.normalized()), -1.0, 1.0));
}

}  // namespace

std::vector<std::size_t> order_of_visit(const Vector3d& p_W, const Vector3d& v_W, const std::vector<Vector3d>& places_W,
                                        const std::vector<double>& extra_s, const StarTourConfig& config) {
  CostMatrix costs(places_W.size() + 1);
  for (std::size_t to = 0; to < places_W.size(); ++to) {
    const Vector3d way = places_W[to] - p_W;
    costs(0, to + 1) = way.norm() / config.speed_mps + config.turn_s * turn_between(v_W, way);
    if (!extra_s.empty()) costs(0, to + 1) += extra_s[to];
    for (std::size_t from = 0; from < places_W.size(); ++from) {
      costs(from + 1, to + 1) = (places_W[to] - places_W[from]).norm() / config.speed_mps;
    }
  }
  std::vector<std::size_t> order;
  for (const std::size_t node : solve_tour(costs, {.max_evaluations = config.effort})) {
    if (node > 0) order.push_back(node - 1);
  }
  return order;
}

StarTour hierarchical_tour(const VoxelGrid& grid, const Vector3d& p_W, const Vector3d& v_W,
                           const std::vector<Vector3d>& places_W, const std::optional<Vector3d>& last_W,
                           const std::vector<Vector3d>& mates_W, const StarTourConfig& config) {
  StarTour tour;
  if (places_W.empty()) return tour;
  const auto clusters = visibility_clusters(grid, places_W, config.radius_m);
  std::vector<Vector3d> middles;
  std::vector<double> extra_s;
  for (const auto& cluster : clusters) {
    Vector3d sum = Vector3d::Zero();
    for (const std::size_t i : cluster) sum += places_W[i];
    middles.push_back(sum / static_cast<double>(cluster.size()));
    const auto near = [&](const Vector3d& place) { return (place - middles.back()).norm() < config.radius_m; };
    const bool another = last_W && !near(*last_W);
    extra_s.push_back((another ? config.history_s : 0.0) + (std::ranges::any_of(mates_W, near) ? config.mate_s : 0.0));
  }
  const auto order = order_of_visit(p_W, v_W, middles, extra_s, config);
  tour.first_cluster_W = middles[order.front()];
  Vector3d at = p_W, velocity = v_W;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<std::size_t>& cluster = clusters[order[i]];
    if (i > 1) {
      tour.visits.insert(tour.visits.end(), cluster.begin(), cluster.end());
      continue;
    }
    std::vector<Vector3d> inside;
    for (const std::size_t member : cluster) inside.push_back(places_W[member]);
    for (const std::size_t member : order_of_visit(at, velocity, inside, {}, config)) {
      tour.visits.push_back(cluster[member]);
    }
    at = places_W[tour.visits.back()];
    velocity.setZero();
  }
  return tour;
}

}  // namespace skein::agent
