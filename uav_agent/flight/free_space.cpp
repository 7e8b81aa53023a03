#include "uav_agent/flight/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr double kSampleM = 0.5;      ///< along a segment
constexpr double kSeenAroundM = 1.0;  ///< how far around a place must be known to be free
constexpr double kTightShare = 0.6;   ///< of the clearance: no way out comes nearer to anything

template <class Test>
bool all_along(const Vector3d& a, const Vector3d& b, const Test& test) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kSampleM)));
  for (int i = 0; i <= steps; ++i) {
    if (!test(a + (b - a) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

}  // namespace

double least_on_way_out_m(double now_m, double clearance_m, double slack_m) {
  return std::max(now_m - slack_m, std::min(now_m, kTightShare * clearance_m));
}

std::string_view to_string(Barrier barrier) {
  switch (barrier) {
    case Barrier::none:
      return "free";
    case Barrier::floor:
      return "below the lowest height of flight (floor_m)";
    case Barrier::other_uav:
      return "too near to another UAV";
    case Barrier::told:
      return "near something that others told of";
    case Barrier::unseen:
      return "in or near a box, or below blind_height_m, and not seen to be free";
    case Barrier::aside:
      return "inside a box, and not near a place of enter_near_W";
    case Barrier::mapped:
      return "nearer than the clearance to something on the map";
  }
  return "";
}

Barrier FreeSpace::barrier_off_map(const Vector3d& p_W) const {
  if (p_W.z() < config_.floor_m) return Barrier::floor;
  for (const Sphere& sphere : keep_out_) {
    if ((p_W - sphere.p_W).squaredNorm() < sphere.radius_m * sphere.radius_m) return Barrier::other_uav;
  }
  if (config_.world) return config_.blind_fleet && near_box(p_W) ? Barrier::unseen : Barrier::none;
  if (near_hearsay(p_W)) return Barrier::told;
  if (!must_be_seen(p_W)) return Barrier::none;
  if (!config_.use_map || !seen_free(p_W)) return Barrier::unseen;
  // A few rays through a coarse cell do not prove that all of it is free: what lies around must have been
  // seen, too.
  for (int i = 0; i < 6; ++i) {
    const Vector3d q = p_W + (i % 2 == 0 ? kSeenAroundM : -kSeenAroundM) * Vector3d::Unit(i / 2);
    if (must_be_seen(q) && !seen_free(q)) return Barrier::unseen;
  }
  const bool wanted = config_.enter_near_W.empty() || !near_box(p_W) ||
                      std::any_of(config_.enter_near_W.begin(), config_.enter_near_W.end(),
                                  [&](const Vector3d& place) { return (place - p_W).norm() < config_.enter_radius_m; });
  return wanted ? Barrier::none : Barrier::aside;
}

Barrier FreeSpace::barrier(const Vector3d& p_W) const {
  const Barrier off_map = barrier_off_map(p_W);
  if (off_map != Barrier::none || !config_.use_map) return off_map;
  if (config_.world) {
    if (config_.proved_only && !config_.fit->fits(p_W)) return Barrier::unseen;
    return config_.world->structure_distance_m(p_W) < config_.clearance_m ? Barrier::mapped : Barrier::none;
  }
  return map_.any_occupied_within(p_W, config_.clearance_m) ? Barrier::mapped : Barrier::none;
}

bool FreeSpace::near_box(const Vector3d& p_W) const {
  const double margin = std::max(config_.clearance_m, config_.jut_m);
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const OrientedBox& box) { return box.contains(p_W, margin); });
}

bool FreeSpace::must_be_seen(const Vector3d& p_W) const { return p_W.z() < config_.blind_height_m || near_box(p_W); }

bool FreeSpace::seen_free(const Vector3d& p_W) const {
  if (map_.known_free(p_W, config_.rays)) return true;
  const auto id = config_.hearsay ? config_.hearsay->at(p_W) : std::nullopt;
  return id && config_.hearsay->state(*id) == VoxelState::free;
}

bool FreeSpace::near_hearsay(const Vector3d& p_W) const {
  if (!config_.hearsay) return false;
  const auto taken = [this](const Vector3d& q) {
    const auto id = config_.hearsay->at(q);
    return id && config_.hearsay->state(*id) == VoxelState::occupied;
  };
  if (taken(p_W)) return true;
  for (int i = 0; i < 6; ++i) {
    if (taken(p_W + (i % 2 == 0 ? config_.clearance_m : -config_.clearance_m) * Vector3d::Unit(i / 2))) return true;
  }
  return false;
}

bool FreeSpace::free(const Vector3d& p_W) const { return barrier(p_W) == Barrier::none; }

double FreeSpace::cost(const Vector3d& p_W) const {
  return config_.fit && !config_.fit->fits(p_W) ? config_.unknown_cost : 1.0;
}

bool FreeSpace::segment_free(const Vector3d& a_W, const Vector3d& b_W) const {
  if (config_.world) return all_along(a_W, b_W, [this](const Vector3d& p) { return free(p); });
  if (!all_along(a_W, b_W, [this](const Vector3d& p) { return allowed(p); })) return false;
  return !config_.use_map || map_.segment_clear(a_W, b_W, config_.clearance_m);
}

bool FreeSpace::looked_at(const Vector3d& a_W, const Vector3d& b_W, double body_m) const {
  return !config_.use_map || config_.world || all_along(a_W, b_W, [&](const Vector3d& p) {
    return (p - a_W).norm() < body_m || !must_be_seen(p) || map_.known_free(p, std::min(kFewestRays, config_.rays));
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
