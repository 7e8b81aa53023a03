#include "uav_agent/flight_core/flight_core.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "uav_agent/flight_core/goal_ids.hpp"

namespace skein::agent {
namespace {

constexpr double kNoLinkS = 4.0;      ///< longest wait for a link at a place that should have one; chosen
constexpr double kIdleS = 4.0;        ///< recovery begins after this time without a goal that can be reached; chosen
constexpr double kMakesRoomS = 10.0;  ///< longest flight aside; chosen
constexpr double kShowCheckS = 5.0;  ///< between two checks of whether a photographer waits to be shown its way; chosen
/// An explorer that flies along the waypoints of a goal goes on for up to this time before it shows a photographer its
/// way.
/// Chosen: flights to photographers from such lines changed the scores of four planners in the wild worlds 200 to 209
/// by at most 0.2 %.
constexpr double kLineS = 10.0;
/// Exchanges between two checks of whether a photographer was shown its way. Chosen.
constexpr std::uint64_t kShowLook = 10;

}  // namespace

FlightCore::FlightCore(const FlightConfig& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      caution_(config, agent),
      filter_(config, agent),
      told_(config, agent),
      navigator_(config, agent, filter_),
      homing_(config, agent),
      recovery_(config, filter_, navigator_),
      showing_(agent, filter_),
      making_room_(config, agent, filter_),
      landing_(config, agent, filter_, navigator_),
      takeoff_(config, agent, filter_, navigator_, landing_) {}

FlightState FlightCore::state() {
  FlightState state{.working = mode_ == Mode::working};
  if (state.working) state.outcomes = std::exchange(outcomes_, {});
  state.idle = state.working && navigator_.idle();
  if (state.working && navigator_.current()) {
    state.goal = navigator_.current()->id;
    state.on_way = navigator_.on_way();
    state.leg = navigator_.leg() + (cut_id_ == state.goal ? cut_legs_ : 0);
  }
  return state;
}

std::optional<Vector3d> FlightCore::going_to_W() const {
  return mode_ == Mode::takeoff || mode_ == Mode::ground ? takeoff_.top_W() : navigator_.going_to_W();
}

Doing FlightCore::doing(const PlannerInput& in) const {
  using enum Doing::What;
  const bool flies = navigator_.current().has_value();
  Doing doing;
  if (flies) doing.goal_W = navigator_.going_to_W();
  switch (mode_) {
    case Mode::ground:
      break;
    case Mode::takeoff:
      doing = {waits_for_ ? awaits_way_up : takeoff, takeoff_.top_W(), {}};
      break;
    case Mode::working:
      doing.what = flies_along() ? along_goal : flies ? to_goal : navigator_.idle() ? no_goal : seeks_way;
      break;
    case Mode::homing:
      doing.what = doing_home(in);
      break;
    case Mode::showing:
      doing.what = shows_mate;
      doing.mate = showing_.mate();
      break;
    case Mode::recovering:
      doing.what = recovery_.doing();
      break;
    case Mode::making_room:
      doing.what = Doing::What::makes_room;
      doing.goal_W = room_W_;
      break;
    case Mode::landing:
      doing.what = Doing::What::lands;
      break;
  }
  return doing;
}

/// Whether the UAV flies along the waypoints of a goal that has several.
bool FlightCore::flies_along() const {
  return navigator_.current() && navigator_.on_way() && navigator_.current()->way.size() > 1;
}

/// The UAV's activity in mode `homing`.
Doing::What FlightCore::doing_home(const PlannerInput& in) const {
  if (in.station_linked && homing_.delivers_here(in)) return Doing::What::delivers;
  if (navigator_.current()) return Doing::What::homing;
  return at_place_since_ ? Doing::What::awaits_link : Doing::What::seeks_way;
}

void FlightCore::enter(Mode mode, const PlannerInput& in) {
  mode_ = mode;
  since_ = in.tick;
}

Steering FlightCore::step(const PlannerInput& in, std::optional<std::vector<Goal>> goals,
                          const std::optional<Stake>& stake) {
  Steering steering;
  waits_for_.reset();
  no_way_.clear();
  timed(in.parts, "flight/told space", [&] { told_.listen(in, navigator_.sees(), filter_); });
  if (goals) {
    wanted_ = std::move(*goals);
    cut_id_.reset();
  }
  const bool asked = goals.has_value();
  if (mode_ != Mode::ground) homing_.update(in, stake);
  if (mode_ != Mode::ground && mode_ != Mode::landing && caution_.must_land(in)) {
    landing_.begin(steering);
    lost_way_home_ = false;
    enter(Mode::landing, in);
  }
  const bool recovers = mode_ == Mode::recovering && !lost_way_home_;
  const bool works = mode_ == Mode::working || recovers || mode_ == Mode::showing;
  if (works && homing_.due(in)) {
    navigator_.stop(steering);
    next_place_ = 0;
    at_place_since_.reset();
    enter(Mode::homing, in);
  }
  switch (mode_) {
    case Mode::ground:
    case Mode::takeoff:
      take_off(in, steering);
      break;
    case Mode::working:
      if (begin_showing(in) || begin_making_room(in, steering)) break;
      if (asked) navigator_.want(wanted_);
      work(in, steering);
      break;
    case Mode::showing:
      show(in, steering);
      break;
    case Mode::homing:
      go_home(in, steering);
      break;
    case Mode::recovering:
      if (!recovery_.step(in, filter_.held(), steering)) break;
      if (std::exchange(lost_way_home_, false)) navigator_.want(wanted_);
      enter(Mode::working, in);
      break;
    case Mode::making_room:
      if (!in.tracking.done && seconds(in.tick - since_) < kMakesRoomS) break;
      steering.motion = Hold{};
      navigator_.want(wanted_);
      enter(Mode::working, in);
      break;
    case Mode::landing:
      if (Landing::landed(in) && caution_.has_full_battery(in)) {
        takeoff_.again();
        enter(Mode::ground, in);
        break;
      }
      landing_.step(in, caution_.must_sink(in), steering);
      break;
  }
  return steering;
}

void FlightCore::take_off(const PlannerInput& in, Steering& steering) {
  if (mode_ == Mode::ground && in.boxes.empty()) return;
  const PartTimer timer(in.parts, "flight/takeoff");
  const Takeoff::Phase phase = takeoff_.step(in, steering);
  waits_for_ = takeoff_.waits_for();
  const Mode mode = phase == Takeoff::Phase::ground   ? Mode::ground
                    : phase == Takeoff::Phase::climbs ? Mode::takeoff
                                                      : Mode::working;
  if (mode == Mode::working) {
    outcomes_.clear();
    navigator_.want(wanted_);
  }
  if (mode != mode_) enter(mode, in);
}

/// The navigator's outcomes since the last call. Notes in no_way_ why a goal was not reached.
std::vector<Outcome> FlightCore::outcomes() {
  std::vector<Outcome> outcomes = navigator_.take_outcomes();
  for (Outcome& outcome : outcomes) {
    if (cut_id_ == outcome.id) outcome.leg += cut_legs_;
    if (outcome.kind != Outcome::Kind::reached) no_way_ = outcome.reason;
  }
  return outcomes;
}

void FlightCore::work(const PlannerInput& in, Steering& steering) {
  navigator_.step(in, filter_.held(), steering);
  for (Outcome& outcome : outcomes()) {
    if (outcome.kind != Outcome::Kind::no_way) recovery_.progress(in);
    if (outcome.kind == Outcome::Kind::reached) held_s_ = 0.0;
    outcomes_.push_back(std::move(outcome));
  }
  if (is_stuck(in)) {
    held_s_ = 0.0;
    navigator_.give_up("held at one place", steering);
    std::ranges::move(outcomes(), std::back_inserter(outcomes_));
    recover(in);
  } else if (navigator_.current()) {
    since_ = in.tick;
    if (filter_.held().by == Held::By::peer) waits_for_ = filter_.held().peer;
  } else if (seconds(in.tick - since_) > kIdleS) {
    recover(in);
  }
}

void FlightCore::recover(const PlannerInput& in) {
  recovery_.begin(in, filter_.held());
  enter(Mode::recovering, in);
}

/// Whether the safety filter has held the UAV at one place for longer than the navigator takes to look around, to yield
/// and to search other paths. Planners that replace their goals do not leave the navigator the time for that; and two
/// UAVs that are too near to each other may hold each other on all of these paths.
bool FlightCore::is_stuck(const PlannerInput& in) {
  const Vector3d& here_W = in.tracking.setpoint.p_WB;
  if ((here_W - held_p_W_).norm() > kStaysM) {
    held_p_W_ = here_W;
    held_s_ = 0.0;
  }
  if (navigator_.current() && filter_.held().by != Held::By::nothing) held_s_ += agent_.exchange_period_s;
  return held_s_ > config_.held_s();
}

/// @returns whether the UAV, which rests, flies aside for another one that stands close to it.
bool FlightCore::begin_making_room(const PlannerInput& in, Steering& steering) {
  if (navigator_.current() || filter_.held().by != Held::By::nothing) return false;
  room_W_ = making_room_.place_W(in);
  if (!room_W_) return false;
  navigator_.stop(steering);
  std::ranges::move(outcomes(), std::back_inserter(outcomes_));
  steering.motion = Path{{{*room_W_, config_.tight_mps}}};
  enter(Mode::making_room, in);
  return true;
}

/// @returns whether the UAV sets out to show a photographer the way up.
bool FlightCore::begin_showing(const PlannerInput& in) {
  if (in.tick < show_at_ || !navigator_.sees()) return false;
  // Better between two goals, but some planners' goals follow one another without a break.
  if (navigator_.on_way() && in.tick < show_at_ + ticks(kLineS)) return false;
  show_at_ = in.tick + ticks(kShowCheckS);
  auto goal = showing_.next(in, navigator_.space(in));
  if (!goal) return false;
  cut_wanted();
  navigator_.want({std::move(*goal)});
  enter(Mode::showing, in);
  return true;
}

/// Removes the flown legs from the goal being flown, so that it later continues at the beginning of the present leg.
void FlightCore::cut_wanted() {
  if (!navigator_.on_way() || navigator_.leg() < 2) return;
  const auto line = std::ranges::find(wanted_, navigator_.current()->id, &Goal::id);
  if (line == wanted_.end()) return;
  const auto flown = static_cast<std::ptrdiff_t>(std::min(navigator_.leg() - 1, line->way.size() - 1));
  line->way.erase(line->way.begin(), line->way.begin() + flown);
  cut_legs_ = static_cast<std::size_t>(flown) + (cut_id_ == line->id ? cut_legs_ : 0);
  cut_id_ = line->id;
}

void FlightCore::show(const PlannerInput& in, Steering& steering) {
  if (!navigator_.idle()) {
    navigator_.step(in, filter_.held(), steering);
    since_ = in.tick;
    const std::vector<Outcome> ended = outcomes();
    const bool failed = !ended.empty() && ended.back().kind != Outcome::Kind::reached;
    if (!failed && !(in.k % kShowLook == 0 && showing_.shown(in))) return;
  } else if (seconds(in.tick - since_) < config_.look_s && !(in.k % kShowLook == 0 && showing_.shown(in))) {
    return;
  }
  navigator_.stop(steering);
  show_at_ = in.tick;  // look for the next photographer at once
  navigator_.want(wanted_);
  enter(Mode::working, in);
}

void FlightCore::go_home(const PlannerInput& in, Steering& steering) {
  if (homing_.done(in)) {
    navigator_.stop(steering);
    outcomes();
    missed_home_ = 0;
    navigator_.want(wanted_);
    enter(Mode::working, in);
    return;
  }
  if (in.station_linked && homing_.delivers_here(in)) {
    navigator_.stop(steering);
    at_place_since_.reset();
    next_place_ = missed_home_ = 0;
    return;
  }
  navigator_.step(in, filter_.held(), steering);
  bool missed = false;
  for (const Outcome& outcome : outcomes()) {
    missed = outcome.kind != Outcome::Kind::reached;
    if (missed) continue;
    at_place_since_ = in.tick;
    recovery_.progress(in);
  }
  const bool shut_in = missed && filter_.held().by == Held::By::structure;
  if (!navigator_.idle() && !shut_in) return;
  if (missed) {
    navigator_.stop(steering);
    if (gives_up_home(++missed_home_, homing_.places(in, navigator_.space(in)).size(), in)) return;
    lost_way_home_ = true;
    recover(in);
    return;
  }
  if (at_place_since_ && seconds(in.tick - *at_place_since_) < kNoLinkS) return;
  at_place_since_.reset();
  const std::vector<Vector3d> places_W = homing_.places(in, navigator_.space(in));
  if (gives_up_home(next_place_, places_W.size(), in)) return;
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < places_W.size(); ++i) {
    const Vector3d& p_W = places_W[(i + next_place_) % places_W.size()];
    goals.push_back({.id = goal_ids::kHome, .way = {{p_W, config_.approach_mps}}});
  }
  ++next_place_;
  navigator_.want(std::move(goals));
}

/// @param tries  flights to places without a link, or searches that found no way to any place.
/// @returns whether the UAV goes back to work, because there were more tries than places.
bool FlightCore::gives_up_home(std::size_t tries, std::size_t places, const PlannerInput& in) {
  if (tries <= places) return false;
  homing_.give_up(in);
  if (homing_.due(in)) return false;
  missed_home_ = 0;
  navigator_.want(wanted_);
  enter(Mode::working, in);
  return true;
}

}  // namespace skein::agent
