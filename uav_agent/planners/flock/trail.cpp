#include "uav_agent/planners/flock/trail.hpp"

#include <algorithm>

#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {
namespace {

constexpr double kFollowM = 6.0, kTrailM = 2.0;  ///< distance behind an explorer; between two places; chosen

}  // namespace

void FlockTrail::note(const Vector3d& p_W) {
  if (places_W_.empty() || (places_W_.back() - p_W).norm() > kTrailM) places_W_.push_back(p_W);
  if (places_W_.size() > kMostTrail) places_W_.pop_front();
}

std::optional<Vector3d> FlockTrail::behind_explorer_W(const PlannerInput& in) const {
  for (auto p_W = places_W_.rbegin(); p_W != places_W_.rend(); ++p_W) {
    const bool taken = std::ranges::any_of(
        in.peers.all(), [&](const Peer& peer) { return peer.visible && (peer.p_W - *p_W).norm() < kFollowM; });
    if (!taken && in.space->free(*p_W)) return *p_W;
  }
  return std::nullopt;
}

bool FlockTrail::same(const Vector3d& a_W, const Vector3d& b_W) { return (a_W - b_W).norm() < kFollowM; }

}  // namespace skein::agent
