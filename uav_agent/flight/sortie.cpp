#include "uav_agent/flight/sortie.hpp"

#include <algorithm>
#include <utility>

#include "core/euler.hpp"
#include "uav_agent/flight/lift_off.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/proof.hpp"
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
constexpr double kAloneS = 120.0;                    ///< so long, whoever has no explorer beside it waits for one
constexpr double kInSightM = 60.0, kCameUpS = 6.0;   ///< so far, and in so long, it sees a roof over somebody else
constexpr double kFewHitsM = 3.0;   ///< around the body, where few rays came by: a crown of which one leaf was hit
constexpr double kSomeHitsM = 2.4;  ///< where an explorer hovers beside it, and has seen more
constexpr double kWorthClimbM = 2.0;
constexpr std::nullopt_t kBesideStart = std::nullopt;

}  // namespace

Sortie::Sortie(const Config& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      pilot_({.speed_mps = config.transit_mps, .retreat_mps = config.retreat_mps}, agent_),
      delivery_({config.deliver_every_s, config.return_margin_s, config.transit_mps}, agent_, pilot_),
      escort_(agent_) {}

void Sortie::know_site(double top_m, double blind_height_m) {
  site_known_ = true;
  top_m_ = top_m;
  blind_height_m_ = blind_height_m;
}

Sortie::Turn Sortie::step(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out) {
  watch_.update(in, pilot_.retreated());
  if (state_ == State::ground) return leave_ground(in, out);
  delivery_.update(in, top_m_);
  escort_.update(in);
  const bool working = state_ == State::working || state_ == State::stirring || state_ == State::escorting;
  if (working && delivery_.due(in)) {
    state_ = State::delivering;
    delivery_.begin(in, space, std::max(blind_height_m_ + kAboveBlindM, kLowestPlaceM), out);
    return Turn::leave;
  }
  situation_ = pilot_.look_out(in, lookout(space), state_ != State::climbing, out);
  if (situation_ != Situation::flying_on) return react(in, out);
  if (state_ == State::climbing) return in.tracking.done ? climb(in, out) : Turn::nothing;
  if (state_ == State::stirring) return in.tracking.done ? begin_work() : Turn::nothing;
  if (state_ == State::escorting) return escort(in, out);
  look_around(in, out);
  if (state_ == State::working && escort_.begin(in, space, pilot_, out)) {
    state_ = State::escorting;
    return Turn::leave;
  }
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

/// To where a mate stands, and turns there for it to be told what is above it.
Sortie::Turn Sortie::escort(const PlannerInput& in, PlannerOutput& out) {
  if (escort_.step(in)) {
    pilot_.stop(out);
    return begin_work();
  }
  out.waits_for = escort_.stands_by();
  if (in.tracking.done && in.tick >= turn_at_) turn(in, out);
  return Turn::nothing;
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
  if (!waits && finds_no_way_ && in.tick < stir_at_) out.waits_for = agent_.first_explorer();
  if (waits || still_s < kStirAfterS || in.tick < stir_at_) return false;
  stir_at_ = in.tick + ticks(kStirEveryS);
  const int attempt = std::min(stirred_++, kMostStirred);
  ++stirs_;
  const Vector3d here = in.tracking.setpoint.p_WB;
  FreeSpace::Config careful = less_careful(space, attempt, agent_.me().body_radius_m + kLeastClearanceM);
  const Role role = agent_.me().role;
  // Above blind_height_m_ nobody needs proof of free space.
  if (role == Role::explorer && stirs_ % 2 == 0 && here.z() < blind_height_m_ && climb_out(in, out)) return true;
  if (role != Role::explorer) careful.rays = std::max(careful.rays, Proof::of(space.rays, Proof::kLast, role));
  careful.enter_radius_m = kAnywhereM;
  careful.floor_m = std::min(careful.floor_m, std::max(here.z(), kLowestM));
  if (stirred_ % 2 == 0) careful.hearsay = nullptr;  // what others told of may be coarse, and in the way
  const FreeSpace way = pilot_.way_space(in, careful, here);
  std::optional<std::vector<Vector3d>> corners;
  if (const auto& goal = pilot_.missed_W()) {
    corners = find_approach(way, in.boxes, here, *goal, kWorthM, {.max_expansions = kApproachExpansions});
  }
  if (!corners) corners = find_way_out(way, in.boxes, here, stirs_);
  finds_no_way_ = !corners && role != Role::explorer;  // nor will it, until one with a LiDAR comes
  if (!corners) return climb_out(in, out);
  pilot_.follow(path_through(*corners, kStirMps), in, out);
  state_ = State::stirring;
  stir_clearance_m_ = careful.clearance_m;
  return true;
}

/// Straight up, as at the start: that takes less room than any other way, and by now somebody may have looked at it.
bool Sortie::climb_out(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB, before = std::exchange(climb_to_, here);
  climb_to_.z() = lift_off_height_m(agent_, in.boxes, here, blind_height_m_, config_.clearance_m);
  knows_above_ = false;  // for open_above_m() to look
  if (agent_.me().role == Role::explorer) looks_since_ = in.tick - ticks(watch_.here_s(in.tick));
  knows_above_ = climb_to_.z() > here.z() + kAtTopM && sky_is_open(in);
  if (!knows_above_ && open_above_m(in, ground_m_ + kRoofM, kColumnM) < here.z() + kWorthClimbM) {
    climb_to_ = before;
    return false;
  }
  state_ = State::climbing;
  lifts_off_ = false;
  climbs_ = 0;
  climb(in, out);
  return true;
}

Sortie::Turn Sortie::leave_ground(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d p = in.state.p_WB;
  if (!looks_since_) looks_since_ = in.tick;
  if (p.z() > kAirborneM) {
    pilot_.stop(out);
    state_ = State::climbing;
    ground_m_ = agent_.me().p_WB_start.z();
    climb_to_ = p;
    was_climbing_ = (p - agent_.me().p_WB_start).head<2>().norm() < kAboveStartM;
    return Turn::nothing;
  }
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
  const bool short_of_top = climb_to_.z() - here.z() > kAtTopM;  // who was restarted in its climb may be above it
  if (short_of_top && climbs_ < kMaxClimbs) {
    if (in.tick < not_before_) return Turn::nothing;
    const double open_m = open_above_m(in, ground_m_ + kRoofM, kColumnM),
                 low_m = std::max(here.z(), ground_m_ + kHoverM);
    open_m >= climb_to_.z() || open_m > low_m + kAtTopM ? rise(open_m, in, out) : look_up(in, out);
    return Turn::nothing;
  }
  if (!site_known_) return Turn::nothing;  // stays where it is until it knows the boxes
  if (was_climbing_) {
    climb_on(in);
    return Turn::nothing;
  }
  if (lifts_off_) {
    pilot_.forget_trail();
    watch_.forgive(in);
  }
  return begin_work();
}

/// Whoever was restarted right above its start was on its way up, or may well be: where it is now, no map shows a way.
void Sortie::climb_on(const PlannerInput& in) {
  was_climbing_ = false;
  climbs_on_ = true;
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
double Sortie::open_above_m(const PlannerInput& in, double roof_m, double room_m) const {
  if (knows_above_) return climb_to_.z();
  return open_height_m(agent_, in.boxes, in.map, climbs_from(in), ground_m_, roof_m, climb_to_.z(), room_m);
}

void Sortie::rise(double height_m, const PlannerInput& in, PlannerOutput& out) {
  rose_at_ = in.tick;
  pilot_.follow(Path{{{{climb_to_.x(), climb_to_.y(), height_m}, config_.climb_mps}}}, in, out);
}

/// Whoever sees, or one that has looked for it, would have found what is above. In a short look, by chance, no frame
/// may have held what is straight above: a roof is wider than that.
bool Sortie::sky_is_open(const PlannerInput& in) {
  const double since_s = seconds(in.tick - *looks_since_);
  if (agent_.me().role == Role::explorer) {
    return since_s > kLookUpS && nothing_above(since_s > kLookLongS ? kColumnM : kFewHitsM, in);
  }
  const bool alone = is_alone(in), came_up = explorer_came_up(in);
  // An explorer that stays beside it, hovering, would have shown a roof by then.
  const double patience_s = !alone || climbs_on_ || starts_beside_explorer() ? kLookLongS : kAloneS;
  const bool looked = came_up || since_s > patience_s;
  return looked && nothing_above(alone ? kFewHitsM : came_up ? kColumnM : kSomeHitsM, in);
}

bool Sortie::nothing_above(double room_m, const PlannerInput& in) const {
  return open_above_m(in, 0.0, room_m) >= climb_to_.z();
}

/// No explorer that sees what is above is beside it: none that started there, nor one that has come.
bool Sortie::is_alone(const PlannerInput& in) {
  const double up_m = ground_m_ + kAtTopM;
  return agent_.me().role != Role::explorer && !explorer_up(up_m, kBesideStart, in) &&
         !explorer_stays(fetched_at_, up_m, Escort::kBesideM, in);
}

/// There may be a roof. Explorers rise as far as they stand free and turn, so that their LiDAR sees all around;
/// photographers wait for what it sees, or until one is above where roofs are. In the end, who is in no box and has
/// seen nothing goes up; others stay below.
void Sortie::look_up(const PlannerInput& in, PlannerOutput& out) {
  const double here_m = climbs_from(in).z(), hover_m = ground_m_ + kHoverM;
  const bool sees = agent_.me().role == Role::explorer, alone = is_alone(in);
  const bool low = here_m < hover_m - kAtTopM;
  const bool over = seconds(in.tick - std::max(*looks_since_, rose_at_)) > kLookLongS;
  if (sky_is_open(in)) {
    knows_above_ = true;
  } else if (over && !(alone && nothing_above(kFewHitsM, in))) {
    climb_to_.z() = std::max(here_m, hover_m);
    knows_above_ = true;
    if (sees) return;
    finds_no_way_ = true;  // until one comes who sees
    stir_at_ = in.tick + ticks(kStirAfterS);
  } else if (low && sees) {
    looks_since_ = in.tick;
    rise(hover_m, in, out);
  } else if (sees && in.tick >= turn_at_) {
    turn(in, out);
  } else if (!sees) {
    waits_for(*agent_.first_explorer(), in, out);
  }
}

/// Whoever does and sees none hears nobody: none will come for it.
bool Sortie::starts_beside_explorer() const {
  return std::ranges::any_of(agent_.fleet, [&](const FleetMember& it) {
    return it.role == Role::explorer && (it.p_WB_start - agent_.me().p_WB_start).norm() < Escort::kBesideM;
  });
}

/// An explorer in sight that is higher than that, and near: it started beside this UAV, or is now so far off, sideways.
bool Sortie::explorer_up(double height_m, std::optional<double> within_m, const PlannerInput& in) const {
  return std::ranges::any_of(in.peers.all(), [&](const Peer& peer) {
    const FleetMember& it = agent_.fleet[peer.uav];
    const Vector3d off = within_m ? peer.p_W - climb_to_ : it.p_WB_start - agent_.me().p_WB_start;
    return peer.visible && it.role == Role::explorer && peer.p_W.z() > height_m &&
           off.head<2>().norm() < within_m.value_or(Escort::kBesideM);
  });
}

/// For a while: it has heard what that one sees.
bool Sortie::explorer_stays(std::optional<Tick>& since, double height_m, double within_m, const PlannerInput& in) {
  if (!explorer_up(height_m, within_m, in))
    since.reset();
  else if (!since)
    since = in.tick;
  return since && seconds(in.tick - *since) > kCameUpS;
}

/// One that stood beside this UAV has come up; or another one is up there.
bool Sortie::explorer_came_up(const PlannerInput& in) {
  const double above_m = std::min(ground_m_ + kRoofM, climb_to_.z()) - kAtTopM;
  return explorer_up(above_m, kBesideStart, in) || explorer_stays(came_up_at_, above_m, kInSightM, in);
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
  } else if (state_ == State::stirring || state_ == State::escorting) {
    if (state_ == State::escorting) escort_.give_up(in);
    return begin_work();
  } else {
    situation_ == Situation::obstacle ? delivery_.try_again(in) : delivery_.try_elsewhere(in);
  }
  return Turn::nothing;
}

}  // namespace skein::agent
