#include "uav_agent/flight/sortie.hpp"

#include <algorithm>

#include "core/euler.hpp"
#include "uav_agent/flight/lift_off.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/way_out.hpp"

namespace skein::agent {
namespace {

constexpr double kAtTopM = 0.5;
constexpr double kAboveStartM = 0.5;  ///< to the side
constexpr double kClimbAgainS = 1.0;  ///< after a climb was stopped
constexpr int kMaxClimbs = 20;
constexpr double kLowestPlaceM = 6.0;  ///< for delivery
constexpr double kAboveBlindM = 2.0;
constexpr double kTurnAfterS = 5.0, kTurnEveryS = 1.1;  ///< of standing still; a little more than key frames are apart
constexpr double kTurn = 0.8;                           ///< [rad]
constexpr double kStirAfterS = 16.0, kStirEveryS = 4.0;
constexpr int kMostStirred = 4;           ///< attempts that grow less careful
constexpr double kLeastClearanceM = 0.7;  ///< of the body, when nothing else has helped
constexpr double kWorthM = 3.0;           ///< nearer to where it wished to be
constexpr int kApproachExpansions = 2000;
constexpr double kStirMps = 2.0, kLowestM = 1.2;  ///< where there is little room, and its floor
constexpr double kClimbClearanceM = 1.0;          ///< of the body: as much as open_height_m() asks for, and to stop in
constexpr double kWaitsS = 1.0;
constexpr double kHoverM = 1.6;                      ///< above its start, to look up from
constexpr double kLookUpS = 5.0, kLookLongS = 16.0;  ///< that shows a roof; that shows what is in a box
constexpr double kAnywhereM = 1e6;

}  // namespace

Sortie::Sortie(const Config& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      pilot_({.speed_mps = config.transit_mps, .retreat_mps = config.retreat_mps}, agent_),
      delivery_({config.deliver_every_s, config.return_margin_s, config.transit_mps}, agent_, pilot_) {}

void Sortie::know_site(double top_m, double blind_height_m) {
  site_known_ = true;
  top_m_ = top_m;
  blind_height_m_ = blind_height_m;
}

Sortie::Turn Sortie::step(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out) {
  watch_.update(in);
  if (state_ == State::ground) return leave_ground(in, out);
  delivery_.update(in, top_m_);
  const bool working = state_ == State::working || state_ == State::stirring;
  if (working && delivery_.due(in)) {
    state_ = State::delivering;
    delivery_.begin(in, space, std::max(blind_height_m_ + kAboveBlindM, kLowestPlaceM), out);
    return Turn::leave;
  }
  situation_ = pilot_.look_out(in, lookout(space), state_ != State::climbing, out);
  if (situation_ != Situation::flying_on) return react(in, out);
  if (state_ == State::climbing) return in.tracking.done ? climb(in, out) : Turn::nothing;
  if (state_ == State::stirring) return in.tracking.done ? begin_work() : Turn::nothing;
  look_around(in, out);
  if (state_ == State::working) return stir(in, space, out) ? Turn::leave : Turn::work;
  return delivery_.step(in, space, out) ? begin_work() : Turn::nothing;
}

void Sortie::waits_for(std::size_t uav, const PlannerInput& in, PlannerOutput& out) {
  waits_at_ = in.tick;
  out.waits_for = uav;
}

/// A LiDAR that has turned makes a new key frame: who stands still learns more of what is around.
void Sortie::look_around(const PlannerInput& in, PlannerOutput& out) {
  if (agent_.me().role != Role::explorer || !in.tracking.done || in.tick < turn_at_) return;
  if (watch_.still_s(in.tick) < kTurnAfterS) return;
  turn(in, out);
}

void Sortie::turn(const PlannerInput& in, PlannerOutput& out) {
  out.yaw = wrap_angle(in.tracking.setpoint.yaw + kTurn);
  turn_at_ = in.tick + ticks(kTurnEveryS);
}

/// Who climbs or is taken elsewhere does with less room than its planner wishes, and must not be stopped for that.
FreeSpace::Config Sortie::lookout(FreeSpace::Config space) const {
  const double body_m = agent_.me().body_radius_m;
  if (state_ == State::climbing) space.clearance_m = std::min(space.clearance_m, body_m + kClimbClearanceM);
  if (state_ == State::stirring) space.clearance_m = std::min(space.clearance_m, stir_clearance_m_);
  return space;
}

/// Takes it somewhere else. @returns whether it sets out.
bool Sortie::stir(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out) {
  const double still_s = watch_.still_s(in.tick);
  if (still_s < kTurnAfterS) stirred_ = 0;
  const bool waits = seconds(in.tick - waits_at_) < kWaitsS;
  if (waits || still_s < kStirAfterS || in.tick < stir_at_) return false;
  stir_at_ = in.tick + ticks(kStirEveryS);
  const int attempt = std::min(stirred_++, kMostStirred);
  const Vector3d here = in.tracking.setpoint.p_WB;
  FreeSpace::Config careful = less_careful(space, attempt, agent_.me().body_radius_m + kLeastClearanceM);
  careful.enter_radius_m = kAnywhereM;
  careful.floor_m = std::min(careful.floor_m, std::max(here.z(), kLowestM));
  if (stirred_ % 2 == 0) careful.hearsay = nullptr;  // what others told of may be coarse, and in the way
  const FreeSpace way = pilot_.way_space(in, careful, here);
  std::optional<std::vector<Vector3d>> corners;
  if (const auto& goal = pilot_.missed_W()) {
    corners = find_approach(way, in.boxes, here, *goal, kWorthM, {.max_expansions = kApproachExpansions});
  }
  if (!corners) corners = find_way_out(way, in.boxes, here, stirred_);
  if (!corners) return false;
  Path path;
  for (const Vector3d& p : *corners) path.waypoints.push_back({p, kStirMps});
  pilot_.follow(std::move(path), in, out);
  state_ = State::stirring;
  stir_clearance_m_ = careful.clearance_m;
  return true;
}

Sortie::Turn Sortie::leave_ground(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d p = in.state.p_WB;
  if (p.z() > kAirborneM) {
    pilot_.stop(out);
    state_ = State::climbing;
    climb_to_ = p;
    was_climbing_ = (p - agent_.me().p_WB_start).head<2>().norm() < kAboveStartM;
    return Turn::nothing;
  }
  if (!looks_since_) looks_since_ = in.tick;
  if (const auto first = pilot_.lifts_off_after(in)) {
    waits_for(*first, in, out);
    return Turn::nothing;
  }
  state_ = State::climbing;
  ground_m_ = p.z();
  knows_above_ = !agent_.first_explorer();
  climb_to_ = {p.x(), p.y(), lift_off_height_m(agent_, in.boxes, p, blind_height_m_, config_.clearance_m)};
  out.gimbal = GimbalCommand{GimbalMode::angle, 0.0, 0.0};
  return climb(in, out);
}

/// At the top: on to work. Stopped on the way, or not sure of what is above: tries again for a while.
Sortie::Turn Sortie::climb(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d here = climbs_from(in);
  const bool short_of_top = (climb_to_ - here).norm() > kAtTopM;
  if (short_of_top && climbs_ < kMaxClimbs) {
    if (in.tick < not_before_) return Turn::nothing;
    const double open_m = open_above_m(in, ground_m_ + kRoofM), low_m = std::max(here.z(), ground_m_ + kHoverM);
    open_m >= climb_to_.z() || open_m > low_m + kAtTopM ? rise(open_m, in, out) : look_up(in, out);
    return Turn::nothing;
  }
  if (!site_known_) return Turn::nothing;  // stays where it is until it knows the boxes
  if (was_climbing_) {
    climb_on(in);
    return Turn::nothing;
  }
  pilot_.forget_trail();
  watch_.forgive(in);
  return begin_work();
}

/// Whoever was restarted right above its start was on its way up, or may well be: where it is now, no map shows a way.
void Sortie::climb_on(const PlannerInput& in) {
  was_climbing_ = false;
  const Vector3d here = climbs_from(in), start = agent_.me().p_WB_start;
  ground_m_ = start.z();
  looks_since_ = in.tick;
  knows_above_ = !agent_.first_explorer();
  const double height_m = lift_off_height_m(agent_, in.boxes, start, blind_height_m_, config_.clearance_m);
  climb_to_ = {here.x(), here.y(), std::max(here.z(), height_m)};
}

Vector3d Sortie::climbs_from(const PlannerInput& in) const {
  return in.tracking.airborne ? in.tracking.setpoint.p_WB : in.state.p_WB;
}

/// How far up it may climb.   @param roof_m  so high up there may be a roof.
double Sortie::open_above_m(const PlannerInput& in, double roof_m) const {
  if (knows_above_) return climb_to_.z();
  return open_height_m(agent_, in.boxes, in.map, climbs_from(in), ground_m_, roof_m, climb_to_.z());
}

void Sortie::rise(double height_m, const PlannerInput& in, PlannerOutput& out) {
  rose_at_ = in.tick;
  pilot_.follow(Path{{{{climb_to_.x(), climb_to_.y(), height_m}, config_.climb_mps}}}, in, out);
}

/// There may be a roof. Explorers rise as far as they stand free and turn, so that their LiDAR sees all around;
/// photographers wait for what it sees. In the end, who is in no box and has seen nothing goes up; others stay below.
void Sortie::look_up(const PlannerInput& in, PlannerOutput& out) {
  const double here_m = climbs_from(in).z(), hover_m = ground_m_ + kHoverM;
  const bool sees = agent_.me().role == Role::explorer;
  const bool low = here_m < hover_m - kAtTopM;
  const bool looked = seconds(in.tick - *looks_since_) > kLookUpS;
  const bool nothing_seen = looked && open_above_m(in, 0.0) >= climb_to_.z();
  if (nothing_seen || seconds(in.tick - std::max(*looks_since_, rose_at_)) > kLookLongS) {
    if (!nothing_seen) climb_to_.z() = std::max(here_m, hover_m);
    knows_above_ = true;
  } else if (low && sees) {
    looks_since_ = in.tick;
    rise(hover_m, in, out);
  } else if (sees && in.tick >= turn_at_) {
    turn(in, out);
  } else if (!sees) {
    waits_for(*agent_.first_explorer(), in, out);
  }
}

Sortie::Turn Sortie::begin_work() {
  state_ = State::working;
  return Turn::begin;
}

/// Something came between this UAV and what it was about.
Sortie::Turn Sortie::react(const PlannerInput& in, PlannerOutput& out) {
  if (situation_ == Situation::waiting) {
    out.waits_for = pilot_.hindered_by();
    return Turn::nothing;
  }
  if (situation_ == Situation::detour) return state_ == State::working ? Turn::detour : Turn::nothing;
  pilot_.stop(out);
  if (state_ == State::working) return Turn::blocked;
  if (state_ == State::climbing) {
    ++climbs_;
    not_before_ = in.tick + ticks(kClimbAgainS);
  } else if (state_ == State::stirring) {
    state_ = State::working;
    return Turn::begin;
  } else {
    situation_ == Situation::obstacle ? delivery_.try_again(in) : delivery_.try_elsewhere(in);
  }
  return Turn::nothing;
}

}  // namespace skein::agent
