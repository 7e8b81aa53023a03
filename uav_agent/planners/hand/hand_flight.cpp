#include "uav_agent/planners/hand/hand_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kRestsMps = 0.01;   ///< slower counts as no motion; chosen
constexpr double kAheadS = 2.0;      ///< the path is as long as the way flown in this time (chosen),
constexpr double kBrakesMps2 = 1.0;  ///< plus the braking distance at this deceleration; chosen: gentle
constexpr double kObeysShare = 0.5;  ///< a UAV faster than this share of the commanded speed is not held back; chosen

}  // namespace

HandFlight::HandFlight(const HandConfig& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      tracker_(tracker_config(agent.vehicle)),
      filter_(config.flight, agent),
      sight_(agent),
      told_(config.flight, agent) {}

/// The commanded velocity within its limits. With the safety filter, the UAV climbs to the floor first, and stays there
/// or above.
Vector3d HandFlight::wanted_velocity_W(const HandCommand& wanted, const PlannerInput& in) {
  const TrackingState tracking = tracker_.tracking();
  const double yaw = tracking.airborne ? tracking.setpoint.yaw : roll_pitch_yaw(in.state.q_WB.toRotationMatrix()).yaw;
  Vector3d v_W = rotation_z(yaw) * Vector3d(wanted.velocity.x(), wanted.velocity.y(), 0.0);
  const double level_mps = v_W.norm();
  if (level_mps > config_.flight.approach_mps) v_W *= config_.flight.approach_mps / level_mps;
  v_W.z() = std::clamp(wanted.velocity.z(), -config_.flight.climb_mps, config_.flight.climb_mps);
  low_ = false;
  if (!config_.safe) return v_W;
  const double height_m = tracking.airborne ? tracking.setpoint.p_WB.z() : in.state.p_WB.z();
  if (height_m > config_.flight.floor_m) return v_W;
  const Vector3d climb_W(0.0, 0.0, std::max(0.0, v_W.z()));
  const bool at_floor = tracking.airborne && height_m > config_.flight.floor_m - kProvedStepM / 2.0;
  const Vector3d allowed_W = at_floor ? Vector3d(v_W.x(), v_W.y(), climb_W.z()) : climb_W;
  low_ = (v_W - allowed_W).norm() > kRestsMps;
  return allowed_W;
}

/// Highest speed at which the UAV would not cover the proved space ahead within ahead_s. In vertical flight only the
/// safety filter limits the speed, as at takeoff.
double HandFlight::pace_mps(const Vector3d& v_W, const PlannerInput& in) const {
  if (filter_.assumes_boxes()) return config_.flight.alone_mps;
  const double speed_mps = v_W.norm();
  const bool upright = v_W.head<2>().norm() <= kRestsMps;
  if (!sight_.sees() || upright || speed_mps <= kCreepMps) return std::numeric_limits<double>::infinity();
  const Vector3d from_W = tracker_.tracking().setpoint.p_WB;
  const double most_m = speed_mps * config_.flight.ahead_s;
  double proved_m = 0.0;
  while (proved_m < most_m &&
         filter_.proved(from_W + v_W / speed_mps * (proved_m + kProvedStepM), *in.world_map, in.boxes)) {
    proved_m += kProvedStepM;
  }
  return std::max(kCreepMps, std::min(proved_m, most_m) / config_.flight.ahead_s);
}

HeldBack HandFlight::why_slower(double wanted_mps, double pace_mps) const {
  if (low_) return HeldBack::low;
  const double speed_mps = tracker_.commanded().v_WB.norm();
  if (wanted_mps <= kRestsMps || speed_mps > kObeysShare * wanted_mps) return HeldBack::no;
  switch (filter_.held().by) {
    case Held::By::nothing:
      return pace_mps < wanted_mps ? HeldBack::unproved : HeldBack::no;  // else the UAV is still accelerating
    case Held::By::unproved:
      return HeldBack::unproved;
    case Held::By::structure:
      return HeldBack::structure;
    case Held::By::peer:
      return HeldBack::peer;
  }
  return HeldBack::no;
}

std::optional<TrajectoryCommand> HandFlight::fly(const HandCommand& wanted, const PlannerInput& in) {
  const double dt_s = agent_.exchange_period_s;
  if (!std::exchange(began_, true) && in.state.p_WB.z() > kBeginsInFlightM) tracker_.hold();
  const Vector3d v_W = wanted_velocity_W(wanted, in);
  const double speed_mps = v_W.norm();
  going_to_W_.reset();
  if (speed_mps > kRestsMps) {
    const TrackingState tracking = tracker_.tracking();
    const Vector3d from_W = tracking.airborne ? tracking.setpoint.p_WB : in.state.p_WB;
    const double length_m = kAheadS * speed_mps + speed_mps * speed_mps / (2.0 * kBrakesMps2);
    Vector3d to_W = from_W + v_W / speed_mps * length_m;
    if (config_.safe && v_W.z() < 0.0) to_W.z() = std::max(to_W.z(), config_.flight.floor_m);
    tracker_.follow({{{to_W, speed_mps}}});
    going_to_W_ = to_W;
  } else if (tracker_.tracking().airborne) {
    tracker_.hold();
  }
  if (tracker_.tracking().airborne && wanted.yaw_rate != 0.0) {
    tracker_.turn_to(wrap_angle(tracker_.commanded().yaw + wanted.yaw_rate * dt_s));
  }
  if (!config_.safe) return tracker_.step(in.state, dt_s);
  sight_.update(in);
  told_.listen(in, sight_.sees(), filter_);
  const double pace_mps = this->pace_mps(v_W, in);
  auto command = filter_.step(
      tracker_, {.tick = in.tick, .state = in.state, .map = *in.world_map, .boxes = in.boxes, .peers = in.peers},
      pace_mps);
  held_back_ = why_slower(speed_mps, pace_mps);
  return command;
}

}  // namespace skein::agent
