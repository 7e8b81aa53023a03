#include "uav_agent/flight_core/takeoff.hpp"

#include <algorithm>
#include <utility>

#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight_core/place_aside.hpp"

namespace skein::agent {
namespace {

constexpr double kLowestTopM = 4.0;   ///< least height of the climb; chosen
constexpr double kClimbLayerM = 2.0;  ///< difference between the heights to which two UAVs climb; chosen
constexpr double kCrowdM = 6.0;       ///< UAVs whose starts are nearer than this lift off one after the other; chosen
constexpr double kClearM = 3.0;       ///< once a UAV is this far from its start, the next one may lift off; chosen
constexpr double kStartPatienceS = 6.0;  ///< wait for each UAV that comes first; later it counts as broken; chosen
constexpr double kRisenM = 1.2;          ///< so high above its start, a UAV may begin to work; chosen
constexpr double kClimbGainM = 0.3;      ///< a UAV that gains less height has stalled; chosen
constexpr double kStepAsideM = 0.3;      ///< step of a UAV that stalled; chosen: more than half a cube of the map
constexpr double kLowAsideM = 0.3;   ///< least height above the start for a flight to another place to climb; chosen
constexpr int kMostGiveWays = 3;     ///< a UAV that could begin to work gives way no more often; chosen
constexpr double kOffGroundM = 0.2;  ///< setpoints that are this far above the start keep a UAV up; chosen
constexpr double kGivesWayS = 8.0;   ///< a UAV that gave way to others does not try again for this time; chosen

}  // namespace

Takeoff::Phase Takeoff::step(const PlannerInput& in, Steering& steering) {
  waits_for_.reset();
  if (phase_ == Phase::climbs) {
    climb(in, steering);
  } else {
    stand(in, steering);
  }
  return phase_;
}

void Takeoff::again() {
  filter_.set_trust(SafetyFilter::Trust::proved);
  filter_.begin_anew();
  phase_ = Phase::ground;
  ready_since_.reset();
  sinks_back_ = false;
  gave_way_ = 0;
}

void Takeoff::stand(const PlannerInput& in, Steering& steering) {
  const Vector3d p_W = in.state.p_WB;
  if (sinks_back_) {
    sinks_back_ = in.tracking.setpoint.p_WB.z() > 0.0;  // with a setpoint below the ground it stands firm
    if (!sinks_back_) filter_.set_trust(SafetyFilter::Trust::proved);
    return;
  }
  if (p_W.z() > kBeginsInFlightM) {
    steering.motion = Hold{};
    phase_ = Phase::over;
    return;
  }
  if (in.tick < stands_until_) return;
  waits_for_ = lifts_off_after(in);
  if (waits_for_ || may_drift_into_neighbours(in)) return;
  top_W_ = Vector3d(p_W.x(), p_W.y(), p_W.z() + kLowestTopM + kClimbLayerM * neighbours_after());
  raise_top(in);
  steering.motion = Path{{{*top_W_, config_.climb_mps}}};
  steering.gimbal = GimbalCommand{GimbalMode::angle, 0.0, 0.0};
  climbed_m_ = p_W.z();
  stepped_aside_ = false;
  aside_ = false;
  climbed_at_ = in.tick;
  phase_ = Phase::climbs;
}

/// Raises top_W_ out of the boxes in which the UAV starts, if it assumes that the boxes are structure: it would find no
/// path out of them. @returns whether it was lower.
bool Takeoff::raise_top(const PlannerInput& in) {
  const std::optional<Vector3d> out_W = filter_.way_out_W(in.boxes);
  if (!out_W || !is_above_start(*top_W_, *out_W)) return false;
  const double top_m = out_W->z() + kClimbLayerM * neighbours_after();
  if (top_W_->z() >= top_m) return false;
  top_W_->z() = top_m;
  return true;
}

/// Number of UAVs with a higher index that start near by, from which each UAV derives a height of its own to climb to.
int Takeoff::neighbours_after() const {
  int count = 0;
  for (std::size_t uav = agent_.self + 1; uav < agent_.fleet.size(); ++uav) {
    if ((agent_.fleet[uav].p_WB_start - agent_.me().p_WB_start).norm() <= kCrowdM) ++count;
  }
  return count;
}

/// The order is: explorers first, then by index. @returns a UAV near by that comes before this one and is still at its
/// start; nullopt if there is none, or this UAV has waited long enough.
std::optional<std::size_t> Takeoff::lifts_off_after(const PlannerInput& in) {
  if (!ready_since_) ready_since_ = in.tick;
  const auto rank = [this](std::size_t uav) {
    return std::pair(agent_.fleet[uav].role == Role::explorer ? 0 : 1, uav);
  };
  int before = 0;
  std::optional<std::size_t> stands;
  for (const Peer& peer : in.peers.all()) {
    const Vector3d start_W = agent_.fleet[peer.uav].p_WB_start;
    if (rank(peer.uav) > rank(agent_.self) || (start_W - agent_.me().p_WB_start).norm() > kCrowdM) continue;
    ++before;
    if ((peer.p_W - start_W).norm() < kClearM) stands = peer.uav;
  }
  return seconds(in.tick - *ready_since_) > kStartPatienceS * before ? std::nullopt : stands;
}

/// A UAV knows its position well on the ground, but not for long in flight. So it lifts off only if the safety filter
/// would not hold it before it is well above the UAVs that stand beside it.
bool Takeoff::may_drift_into_neighbours(const PlannerInput& in) {
  if (!drifts(in)) return false;
  bool clear =
      filter_.clear_up_to(agent_.me().p_WB_start.z() + kClearM, {in.tick, in.state, *in.world_map, in.boxes, in.peers});
  // A LiDAR on the ground does not see all the space above it, so an explorer may lift off into unproved space.
  clear = clear || (navigator_.sees() && filter_.held().by == Held::By::unproved);
  if (!clear && filter_.held().by == Held::By::peer) waits_for_ = filter_.held().peer;
  if (!clear && !waits_for_ && !navigator_.sees()) waits_for_ = agent_.first_explorer();
  return !clear;
}

/// Climbs as high as space is proved free; the UAV begins to work where the climb ends.
void Takeoff::climb(const PlannerInput& in, Steering& steering) {
  if (raise_top(in)) {  // it has received no map for so long that it assumes the boxes only now
    steering.motion = Path{{{*top_W_, config_.climb_mps}}};
    climbed_at_ = in.tick;
    return;
  }
  const double height_m = in.tracking.setpoint.p_WB.z();
  if (height_m > climbed_m_ + kClimbGainM) {
    climbed_m_ = height_m;
    climbed_at_ = in.tick;
  }
  const double risen_m = drifts(in) && !navigator_.sees() ? kClearM : kRisenM;
  const bool risen = in.state.p_WB.z() > agent_.me().p_WB_start.z() + risen_m;
  const bool low = !risen || in.state.p_WB.z() < config_.floor_m;
  if (low && (climbs_aside(in, steering) || gives_way(in, steering))) return;
  if (!risen && drifts(in) && recovers_from_drift(in, steering)) return;
  const bool stalled = stalled_s(in) > config_.stall_s + config_.look_s;
  if (in.tracking.done || (stalled && risen)) {
    steering.motion = Hold{};
    phase_ = Phase::over;
    return;
  }
  if (stalled && !navigator_.sees()) waits_for_ = agent_.first_explorer();
}

/// Climbs from a place aside if structure holds the UAV below the heights at which it could fly to a goal.
/// @returns whether it does.
bool Takeoff::climbs_aside(const PlannerInput& in, Steering& steering) {
  const Held::By held_by = filter_.held().by;
  // On its way to a place aside, a UAV may be held by another one that has moved meanwhile: try the next place.
  const bool held = held_by == Held::By::structure || (aside_ && held_by == Held::By::peer);
  if (!held || stalled_s(in) <= config_.stall_s || in.tick < next_search_at_) return false;
  next_search_at_ = in.tick + ticks(config_.stall_s);
  const std::optional<Vector3d> place_W = place_aside_W(in);
  if (!place_W) return false;
  aside_ = true;
  climb_from(*place_W, in, steering);
  return true;
}

/// Steps aside, or sinks back to the ground, if drift of the position requires that. @returns whether the UAV does.
bool Takeoff::recovers_from_drift(const PlannerInput& in, Steering& steering) {
  // The clearance for drift may reach an unproved cube right above the UAV, which its LiDAR never sees: step aside.
  const bool looked = navigator_.sees() && stalled_s(in) > config_.look_s;
  if (looked && !stepped_aside_ && filter_.held().by == Held::By::unproved) {
    stepped_aside_ = true;
    climb_from(in.tracking.setpoint.p_WB + kStepAsideM * away_from_neighbours_W(in), in, steering);
    return true;
  }
  if (stalled_s(in) <= config_.stall_s + (navigator_.sees() ? config_.look_s : 0.0)) return false;
  sink_back(in, steering);
  return true;
}

/// A UAV that hovers close above the ground holds the UAVs that stand beside it. So if it can neither climb nor fly
/// aside, it sinks back to the ground, and lets them climb. @returns whether it does.
bool Takeoff::gives_way(const PlannerInput& in, Steering& steering) {
  const Held::By held_by = filter_.held().by;
  const bool stuck = held_by == Held::By::structure || held_by == Held::By::peer;
  const double up_m = in.tracking.setpoint.p_WB.z() - agent_.me().p_WB_start.z();
  if (!stuck || stalled_s(in) <= config_.stall_s + config_.yield_s || !has_neighbours(in)) return false;
  if (up_m < kOffGroundM || (up_m > kRisenM && gave_way_ == kMostGiveWays)) return false;
  ++gave_way_;
  stands_until_ = in.tick + ticks(kGivesWayS);
  sink_back(in, steering);
  return true;
}

void Takeoff::sink_back(const PlannerInput& in, Steering& steering) {
  filter_.set_trust(SafetyFilter::Trust::start);
  steering.motion = landing_.down_at(in.tracking.setpoint.p_WB, in);
  sinks_back_ = true;
  phase_ = Phase::ground;
}

/// Whether a UAV that starts near by has not been seen to leave.
bool Takeoff::has_neighbours(const PlannerInput& in) const {
  return std::ranges::any_of(in.peers.all(), [&](const Peer& peer) {
    const Vector3d& start_W = agent_.fleet[peer.uav].p_WB_start;
    return (start_W - agent_.me().p_WB_start).norm() <= kCrowdM && (peer.p_W - start_W).norm() < kClearM;
  });
}

/// The next place aside to which, and up from which, nothing known would hold the UAV; nullopt if there is none.
std::optional<Vector3d> Takeoff::place_aside_W(const PlannerInput& in) {
  const auto places_W = places_aside_W(in.state.p_WB, top_W_->z(), filter_.tube_m(0.0), *in.world_map);
  const SafetyFilter::Facts facts{in.tick, in.state, *in.world_map, in.boxes, in.peers};
  for (std::size_t tries = 0; tries < places_W.size(); ++tries) {
    Vector3d place_W = places_W[next_aside_++ % places_W.size()];
    place_W.z() = std::max(place_W.z(), agent_.me().p_WB_start.z() + kLowAsideM);
    const Held held = filter_.would_hold({place_W, {place_W.x(), place_W.y(), config_.floor_m}}, facts);
    if (held.by != Held::By::structure && held.by != Held::By::peer) return place_W;
  }
  return std::nullopt;
}

/// Flies to a place, and climbs from there.
void Takeoff::climb_from(const Vector3d& place_W, const PlannerInput& in, Steering& steering) {
  climbed_at_ = in.tick;
  top_W_ = Vector3d(place_W.x(), place_W.y(), top_W_->z());
  steering.motion = Path{{{place_W, config_.tight_mps}, {*top_W_, config_.climb_mps}}};
}

/// Horizontal unit vector away from the other UAVs near by; the nearest ones count most.
Vector3d Takeoff::away_from_neighbours_W(const PlannerInput& in) const {
  Vector3d away_W = Vector3d::Zero();
  for (const Peer& peer : in.peers.all()) {
    Vector3d off_W = in.state.p_WB - peer.p_W;
    off_W.z() = 0.0;
    if (off_W.norm() > 0.0 && off_W.norm() <= kCrowdM) away_W += off_W.normalized() / off_W.squaredNorm();
  }
  return away_W.norm() > 0.0 ? Vector3d(away_W.normalized()) : Vector3d::UnitX();
}

}  // namespace skein::agent
