#include "uav_agent/planners/star/way.hpp"

#include <algorithm>

#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/rounding.hpp"

namespace skein::agent {
namespace {

constexpr double kFarM = 15.0;  ///< a first place farther away is approached with transit_mps; chosen

}  // namespace

std::vector<Waypoint> star_way(const FreeSpace& space, const Vector3d& from_W, const std::vector<Vector3d>& places_W,
                               const StarWayConfig& config) {
  std::vector<Vector3d> corners;
  Vector3d at = from_W;
  double length = 0.0;
  for (const Vector3d& place : places_W) {
    if ((!corners.empty() && length >= config.horizon_m) || !space.segment_free(at, place)) break;
    length += (place - at).norm();
    at = place;
    corners.push_back(place);
  }
  if (corners.empty()) return {};
  const bool far = (corners.front() - from_W).norm() > kFarM;
  const auto free = [&](const Vector3d& a, const Vector3d& b) { return space.segment_free(a, b); };
  auto waypoints = path_through(rounded(from_W, corners, config.round_m, free), config.speed_mps).waypoints;
  if (far) waypoints.front().speed_mps = std::max(config.speed_mps, config.transit_mps);
  return waypoints;
}

}  // namespace skein::agent
