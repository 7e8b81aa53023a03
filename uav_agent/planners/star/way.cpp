#include "uav_agent/planners/star/way.hpp"

#include <algorithm>

#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/pilot.hpp"
#include "uav_agent/flight/rounding.hpp"
#include "uav_agent/flight/voxel_route.hpp"

namespace skein::agent {
namespace {

constexpr double kFarM = 15.0;  ///< a longer way is flown fast
constexpr int kRouteEffort = 2500, kSearchEffort = 3000, kRouteRetries = 1;
constexpr double kRouteWeight = 1.5;  ///< a way half as long again will do

std::optional<std::vector<Vector3d>> way_to(const VoxelGrid& grid, const FreeSpace& space,
                                            const std::vector<OrientedBox>& structure, const Vector3d& from_W,
                                            const Vector3d& to_W) {
  if (space.segment_free(from_W, to_W)) return std::vector<Vector3d>{to_W};
  VoxelRouteConfig route;
  route.search.max_expansions = kRouteEffort;
  route.search.heuristic_weight = kRouteWeight;
  route.retries = kRouteRetries;
  if (auto corners = find_voxel_route(grid, space, from_W, to_W, {}, route)) return corners;
  PathSearchConfig search;
  search.max_expansions = kSearchEffort;
  return find_path(space, structure, from_W, to_W, search);
}

}  // namespace

std::optional<Path> star_way(const VoxelGrid& grid, const FreeSpace& space, const std::vector<OrientedBox>& structure,
                             const Vector3d& from_W, const std::vector<Vector3d>& places_W, double speed_mps,
                             const StarWayConfig& config) {
  auto corners = way_to(grid, space, structure, from_W, places_W.front());
  if (!corners) return std::nullopt;
  double length = path_length(from_W, *corners);
  const std::size_t fast = length > kFarM ? corners->size() : 0;
  for (std::size_t i = 1; i < places_W.size() && length < config.horizon_m; ++i) {
    const Vector3d from = corners->back();
    if (!space.segment_free(from, places_W[i])) break;
    length += (places_W[i] - from).norm();
    corners->push_back(places_W[i]);
  }
  const auto free = [&](const Vector3d& a, const Vector3d& b) { return space.segment_free(a, b); };
  Path path = path_through(rounded(from_W, *corners, config.round_m, free), speed_mps);
  for (std::size_t i = 0; i < std::min(fast, path.waypoints.size()); ++i) {
    path.waypoints[i].speed_mps = std::max(speed_mps, config.transit_mps);
  }
  return path;
}

}  // namespace skein::agent
