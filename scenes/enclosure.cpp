#include "scenes/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace skein::sim {
namespace {

constexpr double kHorizon = 1e6;  ///< beyond any structure
constexpr int kDirections = 256;
constexpr std::size_t kMostPlaces = 1000;
constexpr double kPlaceSpacing = 1.0;
constexpr double kFromWall = 0.5;  ///< distance of the next place from the hit of a ray, towards the ray's start

/// Directions that cover the sphere evenly, from up to down: points on a spiral with steps of the golden angle. Each
/// place has different directions, so that another place may find a narrow way out that one place misses.
Vector3d direction(std::size_t place, int i) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double turn = golden_angle * (i + static_cast<double>(place) * kDirections);
  const double whole = static_cast<double>(place) * std::numbers::phi + 0.5;
  const double z = 1.0 - 2.0 * (i + whole - std::floor(whole)) / kDirections;
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace

bool is_enclosed(const RayScene& world, const Vector3d& p_W) {
  RayFilter filter;
  filter.uavs = false;
  std::vector<Vector3d> places = {p_W};
  const auto is_new = [&](const Vector3d& place) {
    return std::none_of(places.begin(), places.end(),
                        [&](const Vector3d& known) { return (known - place).norm() < kPlaceSpacing; });
  };
  for (std::size_t seen = 0; seen < places.size(); ++seen) {
    for (int i = 0; i < kDirections; ++i) {
      const Vector3d d_W = direction(seen, i);
      const std::optional<Hit> hit = world.first_hit(places[seen], d_W, kHorizon, filter);
      if (!hit) return false;
      const Vector3d next = places[seen] + std::max(0.0, hit->distance - kFromWall) * d_W;
      if (places.size() < kMostPlaces && is_new(next)) places.push_back(next);
    }
  }
  return true;
}

double world_reach_m(const Scenario& scenario, const Scene& scene) {
  constexpr double kFast_mps = 50.0, kRoom_m = 1000.0;
  double farthest_m = scenario.station_position.norm();
  for (const UavConfig& uav : scenario.fleet) farthest_m = std::max(farthest_m, uav.start.norm());
  for (const auto& vertex : scene.mesh.vertices) {
    farthest_m = std::max(farthest_m, static_cast<double>(vertex.norm()));
  }
  return farthest_m + kFast_mps * (scenario.takeoff_timeout_s + scenario.duration_s) + kRoom_m;
}

}  // namespace skein::sim
