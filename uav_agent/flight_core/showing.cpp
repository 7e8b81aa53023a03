#include "uav_agent/flight_core/showing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "uav_agent/flight_core/goal_ids.hpp"

namespace skein::agent {
namespace {

constexpr double kLowM = 1.0;        ///< a UAV that has left its start and is higher above it has risen; chosen
constexpr double kColumnTopM = 6.0;  ///< height of the space above a start that is shown; chosen
/// Offsets of the places to hover from the photographer: horizontal distance, and heights to try in this order. From
/// there a LiDAR sees the column well, unless a roof is in between. Chosen.
constexpr double kAsideM = 5.0, kAboveM[] = {5.0, 2.5, 8.0, 12.0};
constexpr int kSides = 8;         ///< number of directions in which these places lie; chosen
constexpr double kShowMps = 4.0;  ///< speed on the way there; chosen
/// Pause after an attempt. After the first kManyAttempts, it doubles each time, kMostDoublings times at most. Chosen.
constexpr double kAgainS = 20.0;
constexpr int kManyAttempts = 4, kMostDoublings = 8;  ///< chosen
/// A photographer that has not risen after this time may not have received the map of its column. Chosen.
constexpr double kToldS = 60.0;
constexpr double kAsideOfStartM = 0.5;  ///< a UAV farther from its start has moved aside; chosen
constexpr double kNearM = 14.0;         ///< an explorer this near to a photographer's place would see it there; chosen
/// Before an explorer takes over a photographer, it waits this time for each explorer that starts nearer to it.
/// Measured: in `towers`, `cranes` and `hangar`, photographers rise within 55 s if no UAV is lost.
constexpr double kTakeOverS = 60.0;

}  // namespace

Showing::Showing(const AgentConfig& agent, const SafetyFilter& filter) : agent_(agent), filter_(filter) {
  if (agent.me().role != Role::explorer) return;
  for (std::size_t i = 0; i < agent.fleet.size(); ++i) {
    if (agent.fleet[i].role == Role::explorer) continue;
    const auto rank = [&](std::size_t j) {
      return std::pair((agent.fleet[j].p_WB_start - agent.fleet[i].p_WB_start).norm(), j);
    };
    Charge charge{.uav = i};
    for (std::size_t j = 0; j < agent.fleet.size(); ++j) {
      if (agent.fleet[j].role == Role::explorer && rank(j) < rank(agent.self)) ++charge.nearer;
    }
    charges_.push_back(charge);
  }
}

bool Showing::is_visible(std::size_t uav, const PlannerInput& in) {
  const Peer* const peer = in.peers.find(uav);
  return peer != nullptr && peer->visible;
}

bool Showing::has_risen(std::size_t uav, const PlannerInput& in) const {
  const Peer* const peer = in.peers.find(uav);
  if (peer == nullptr || !peer->seen) return false;
  const Vector3d from_start = peer->p_W - agent_.fleet[uav].p_WB_start;
  return from_start.norm() > kLeftStartM && from_start.z() > kLowM;
}

bool Showing::is_due(const Charge& charge, const PlannerInput& in) const {
  if (in.tick < charge.not_before) return false;
  if (charge.nearer == 0) return true;
  if (seconds(in.tick - *since_) <= kTakeOverS * charge.nearer) return false;
  return is_visible(charge.uav, in);
}

Vector3d Showing::place_W(std::size_t uav, const PlannerInput& in) const {
  Vector3d place_W = agent_.fleet[uav].p_WB_start;
  const Peer* const peer = in.peers.find(uav);
  const bool aside = peer != nullptr && peer->seen && (peer->p_W - place_W).norm() >= kAsideOfStartM;
  if (aside) place_W.head<2>() = peer->p_W.head<2>();
  return place_W;
}

bool Showing::column_known(std::size_t uav, const PlannerInput& in) const {
  const double radius_m = filter_.tube_of_told_m(uav);
  Vector3d low_W = place_W(uav, in), top_W = low_W;
  low_W.z() += radius_m + 1.0;
  top_W.z() += kColumnTopM;
  return in.world_map->tube_free(low_W, top_W, radius_m);
}

std::optional<Goal> Showing::next(const PlannerInput& in, const FreeSpace& space) {
  if (!since_) since_ = in.tick;
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  // If this UAV hovers beside the mate's place and does not see the mate, the mate has risen in the meantime.
  const bool looked = std::exchange(was_known_, false) && (place_W(mate_, in) - here_W).norm() < kNearM;
  const bool gone = looked && !is_visible(mate_, in);
  std::erase_if(charges_, [&](const Charge& it) { return has_risen(it.uav, in) || (gone && it.uav == mate_); });
  const auto off_m = [&](const Charge& it) { return (agent_.fleet[it.uav].p_WB_start - here_W).norm(); };
  std::ranges::stable_sort(charges_, {}, off_m);
  for (Charge& it : charges_) {
    if (!is_due(it, in)) continue;
    const bool known = column_known(it.uav, in);
    if (known && seconds(in.tick - *since_) < kToldS) continue;
    const Vector3d low_W = place_W(it.uav, in);
    const double heading = std::atan2(here_W.y() - low_W.y(), here_W.x() - low_W.x());
    for (std::size_t height = 0; height < std::size(kAboveM); ++height) {
      const double above_m = kAboveM[(height + static_cast<std::size_t>(it.attempts)) % std::size(kAboveM)];
      for (int i = 0; i < kSides; ++i) {
        const int side = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
        const double a = heading + 2.0 * std::numbers::pi * side / kSides;
        const Vector3d p_W = low_W + Vector3d(kAsideM * std::cos(a), kAsideM * std::sin(a), above_m);
        if (!space.free(p_W)) continue;
        mate_ = it.uav;
        was_known_ = known;
        ++it.attempts;
        it.not_before =
            in.tick + ticks(std::ldexp(kAgainS, std::clamp(it.attempts - kManyAttempts, 0, kMostDoublings)));
        return Goal{.id = goal_ids::kShowing, .way = {{p_W, kShowMps}}};
      }
    }
  }
  return std::nullopt;
}

bool Showing::shown(const PlannerInput& in) const {
  return has_risen(mate_, in) || (!was_known_ && column_known(mate_, in));
}

}  // namespace skein::agent
