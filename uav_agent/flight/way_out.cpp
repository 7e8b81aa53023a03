#include "uav_agent/flight/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "uav_agent/flight/path_search.hpp"

namespace skein::agent {
namespace {

constexpr int kHeadings = 8;
constexpr int kHeadingStep = 3;  ///< of the first direction, from one attempt to the next; without a common factor
constexpr double kDistances[] = {12.0, 7.0};
constexpr double kHeights[] = {3.0, 0.0, -3.0, 8.0};
constexpr int kMaxSearches = 12, kMaxExpansions = 500;

}  // namespace

FreeSpace::Config less_careful(FreeSpace::Config space, int attempt, double least_clearance_m) {
  for (int i = 0; i < attempt; ++i) {
    space.rays = std::max(std::min(kFewestRays, space.rays), space.rays / 2);
    space.clearance_m = std::max(least_clearance_m, 0.8 * space.clearance_m);
  }
  return space;
}

std::optional<std::vector<Vector3d>> find_way_out(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                                  const Vector3d& from_W, int attempt) {
  int searches = 0;
  for (const double distance : kDistances) {
    for (int i = 0; i < kHeadings; ++i) {
      const double heading = 2.0 * std::numbers::pi * ((i + kHeadingStep * attempt) % kHeadings) / kHeadings;
      for (const double height : kHeights) {
        Vector3d to = from_W + Vector3d(distance * std::cos(heading), distance * std::sin(heading), height);
        to.z() = std::max(to.z(), space.config().floor_m);
        if (!space.free(to)) continue;
        if (++searches > kMaxSearches) return std::nullopt;
        if (auto corners = find_path(space, structure, from_W, to, {.max_expansions = kMaxExpansions})) return corners;
      }
    }
  }
  return std::nullopt;
}

}  // namespace skein::agent
