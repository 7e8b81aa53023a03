#include "uav_agent/flight_core/landing_place.hpp"

#include <algorithm>
#include <vector>

namespace skein::agent {
namespace {

constexpr double kSameM = 0.1;    ///< smaller distances count as this: no factor can separate two equal places; numeric
constexpr double kRoundM = 1e-6;  ///< added so that rounding does not leave two places too close; numeric
constexpr int kMostTurns = 10;    ///< numeric: bounds the effort

using Places = std::vector<Vector3d>;
using Group = std::vector<std::size_t>;

/// Indices of the places that are linked with `first`, including itself, in ascending order.
Group group_of(std::size_t first, const Places& places_W, double apart_m) {
  Group group = {first};
  for (std::size_t next = 0; next < group.size(); ++next) {
    for (std::size_t i = 0; i < places_W.size(); ++i) {
      const bool linked = (places_W[i] - places_W[group[next]]).norm() < apart_m;
      if (linked && std::ranges::find(group, i) == group.end()) group.push_back(i);
    }
  }
  std::ranges::sort(group);
  return group;
}

/// Moves the places of a group away from its centre by one factor, so that the closest two are apart_m apart.
void spread(const Group& group, double apart_m, Places& places_W) {
  Vector3d centre_W = Vector3d::Zero();
  double closest_m = apart_m;
  for (const std::size_t i : group) {
    centre_W += places_W[i] / static_cast<double>(group.size());
    for (const std::size_t j : group) {
      if (j < i) closest_m = std::min(closest_m, std::max(kSameM, (places_W[i] - places_W[j]).norm()));
    }
  }
  const double factor = (apart_m + kRoundM) / closest_m;
  for (const std::size_t i : group) places_W[i] = centre_W + factor * (places_W[i] - centre_W);
}

}  // namespace

Vector3d landing_place_W(const AgentConfig& agent, double apart_m) {
  Places places_W;
  for (const FleetMember& member : agent.fleet) {
    places_W.emplace_back(member.p_WB_start.x(), member.p_WB_start.y(), 0.0);
  }
  // Repeat: a group that was spread may now be close to another one.
  bool any_moved = true;
  for (int turn = 0; any_moved && turn < kMostTurns; ++turn) {
    any_moved = false;
    for (std::size_t first = 0; first < places_W.size(); ++first) {
      const Group group = group_of(first, places_W, apart_m);
      if (group.size() < 2 || group.front() != first) continue;
      spread(group, apart_m, places_W);
      any_moved = true;
    }
  }
  return places_W.at(agent.self);
}

}  // namespace skein::agent
