#include "uav_agent/flight/free_space.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/flight/site.hpp"

namespace skein::agent {
namespace {

constexpr double kSampleM = 0.5;      ///< between the samples of a segment; chosen: a cube of the map
constexpr double kSeenAroundM = 1.0;  ///< around a place, space this far away must be known to be free, too; chosen
/// A way out may come this much nearer to structure: the map's cubes are coarse. Chosen.
constexpr double kNearerM = 0.3;

bool all_along(const Vector3d& a, const Vector3d& b, const auto& test) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kSampleM)));
  for (int i = 0; i <= steps; ++i) {
    if (!test(a + (b - a) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

}  // namespace

bool FreeSpace::kept_out(const Vector3d& p_W) const {
  return std::ranges::any_of(keep_out_, [&](const Sphere& sphere) {
    return (p_W - sphere.p_W).squaredNorm() < sphere.radius_m * sphere.radius_m;
  });
}

bool FreeSpace::allowed(const Vector3d& p_W) const {
  if (p_W.z() < config_.floor_m || kept_out(p_W)) return false;
  if (config_.world) return !config_.blind_fleet || !near_box(p_W);
  if (!near_box(p_W)) return true;
  if (!config_.use_map || !map_.known_free(p_W, kProofRays)) return false;
  // A few rays through a coarse cell do not prove that all of it is free: the space around p must be known to be
  // free, too.
  for (int i = 0; i < 6; ++i) {  // geometry: both directions along three axes
    const Vector3d q = p_W + (i % 2 == 0 ? kSeenAroundM : -kSeenAroundM) * Vector3d::Unit(i / 2);
    if (near_box(q) && !map_.known_free(q, kProofRays)) return false;
  }
  return true;
}

bool FreeSpace::free(const Vector3d& p_W) const {
  if (!allowed(p_W)) return false;
  if (!config_.use_map) return true;
  if (!config_.world) return !map_.any_occupied_within(p_W, config_.clearance_m);
  if (config_.proved_only && !config_.fit->fits(p_W)) return false;
  return config_.world->structure_distance_m(p_W) >= config_.clearance_m;
}

bool FreeSpace::near_box(const Vector3d& p_W) const {
  const double margin = std::max(config_.clearance_m, config_.jut_m);
  const std::optional<Vector3d>& out_W = config_.way_out_W;
  if (config_.blind_fleet && out_W && is_above_start(p_W, *out_W) && p_W.z() <= out_W->z()) return false;
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const OrientedBox& box) { return box.contains(p_W, margin); });
}

double FreeSpace::cost(const Vector3d& p_W) const {
  return config_.fit && !config_.fit->fits(p_W) ? config_.unknown_cost : 1.0;
}

bool FreeSpace::segment_free(const Vector3d& a_W, const Vector3d& b_W) const {
  if (config_.world) return all_along(a_W, b_W, [this](const Vector3d& p) { return free(p); });
  if (!all_along(a_W, b_W, [this](const Vector3d& p) { return allowed(p); })) return false;
  return !config_.use_map || map_.segment_clear(a_W, b_W, config_.clearance_m);
}

double FreeSpace::structure_distance_m(const Vector3d& p_W) const {
  if (config_.world) return std::min(config_.world->structure_distance_m(p_W), config_.clearance_m);
  if (!config_.use_map) return config_.clearance_m;
  return map_.distance_to_occupied(p_W, config_.clearance_m).value_or(config_.clearance_m);
}

bool FreeSpace::leads_out(const Vector3d& a_W, const Vector3d& b_W) const {
  const double least_m = structure_distance_m(a_W) - kNearerM;
  return all_along(a_W, b_W, [&](const Vector3d& p_W) {
    // The distance to structure is 0 in an occupied cube and beside it, so it cannot tell the two apart.
    const bool in_structure = config_.world ? config_.world->at(p_W) == Space::occupied : map_.occupied(p_W);
    return !in_structure && !kept_out(p_W) && structure_distance_m(p_W) >= least_m;
  });
}

bool FreeSpace::sees(const Vector3d& a_W, const Vector3d& b_W, double radius) const {
  const bool past_boxes = all_along(a_W, b_W, [this](const Vector3d& p) {
    return std::none_of(boxes_.begin(), boxes_.end(), [&](const OrientedBox& box) { return box.contains(p); }) ||
           (config_.world ? config_.world->at(p) == Space::free : config_.use_map && map_.known_free(p));
  });
  return past_boxes && (!config_.use_map || map_.segment_clear(a_W, b_W, radius));
}

}  // namespace skein::agent
