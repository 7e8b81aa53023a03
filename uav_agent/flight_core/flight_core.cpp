#include "uav_agent/flight_core/flight_core.hpp"

#include <algorithm>
#include <utility>

#include "uav_agent/flight_core/place_aside.hpp"

namespace skein::agent {
namespace {

constexpr double kAirborneM = 2.0;       ///< a UAV that begins above this height was restarted in flight
constexpr double kLowestTopM = 4.0;      ///< least height of the climb at takeoff
constexpr double kClimbLayerM = 2.0;     ///< difference between the heights to which two UAVs climb
constexpr double kCrowdM = 6.0;          ///< UAVs whose starts are nearer than this lift off one after the other
constexpr double kClearM = 3.0;          ///< once a UAV is this far from its start, the next one may lift off
constexpr double kStartPatienceS = 6.0;  ///< longest wait for each UAV before; then it is taken to be broken
constexpr double kRisenM = 1.2;          ///< so high above its start, a UAV may begin to work
constexpr double kClimbGainM = 0.3;
constexpr double kStepAsideM = 0.3;  ///< more than half a cube of the map
constexpr double kLowAsideM = 0.3;   ///< least height above the start at which a UAV flies to another place to climb
constexpr double kNoLinkS = 4.0;     ///< longest wait for a link at a place that should have one
constexpr double kIdleS = 4.0;       ///< recovery begins after so long without a goal that can be reached
constexpr std::int64_t kHome = -2;
constexpr double kShowCheckS = 5.0;
constexpr std::uint64_t kShowLook = 10;  ///< exchanges between two checks of whether a photographer was shown its way

}  // namespace

FlightCore::FlightCore(const FlightConfig& config, const AgentConfig& agent)
    : config_(config),
      agent_(agent),
      caution_(config, agent),
      filter_(config, agent),
      told_(config, agent),
      navigator_(config, agent, filter_),
      homing_(config, agent),
      recovery_(config, navigator_),
      showing_(agent, filter_),
      landing_(config, agent, filter_, navigator_) {}

FlightState FlightCore::state() {
  FlightState state{.working = mode_ == Mode::working};
  if (state.working) state.outcomes = std::exchange(outcomes_, {});
  state.idle = state.working && navigator_.idle();
  if (state.working && navigator_.current()) {
    state.goal = navigator_.current()->id;
    state.on_way = navigator_.on_way();
    state.leg = navigator_.leg();
  }
  return state;
}

std::optional<Vector3d> FlightCore::going_to_W() const {
  return mode_ == Mode::takeoff || mode_ == Mode::ground ? top_W_ : navigator_.going_to_W();
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
      doing = {waits_for_ ? awaits_way_up : takeoff, top_W_, {}};
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

/// What the UAV does in mode `homing`.
Doing::What FlightCore::doing_home(const PlannerInput& in) const {
  if (in.station_linked && homing_.delivers_here(in)) return Doing::What::delivers;
  if (navigator_.current()) return Doing::What::homing;
  return at_place_since_ ? Doing::What::awaits_link : Doing::What::seeks_way;
}

void FlightCore::enter(Mode mode, const PlannerInput& in) {
  mode_ = mode;
  since_ = in.tick;
}

Steering FlightCore::step(const PlannerInput& in, std::optional<std::vector<Goal>> goals) {
  Steering steering;
  waits_for_.reset();
  no_way_.clear();
  told_.listen(in, navigator_.sees(), filter_);
  if (goals) wanted_ = std::move(*goals);
  const bool asked = goals.has_value();
  if (mode_ != Mode::ground) homing_.update(in);
  if (mode_ != Mode::ground && mode_ != Mode::landing && caution_.must_land(in)) {
    landing_.begin(steering);
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
      leave_ground(in, steering);
      break;
    case Mode::takeoff:
      take_off(in, steering);
      break;
    case Mode::working:
      if (begin_showing(in)) break;
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
      lost_way_home_ = false;
      enter(Mode::working, in);
      break;
    case Mode::landing:
      landing_.step(in, caution_.must_sink(in), steering);
      break;
  }
  return steering;
}

void FlightCore::leave_ground(const PlannerInput& in, Steering& steering) {
  const Vector3d p_W = in.state.p_WB;
  if (in.boxes.empty()) return;
  if (sinks_back_) {
    sinks_back_ = in.tracking.setpoint.p_WB.z() > 0.0;  // with a setpoint below the ground it stands firm
    if (!sinks_back_) filter_.set_trust(SafetyFilter::Trust::proved);
    return;
  }
  if (p_W.z() > kAirborneM) {
    steering.motion = Hold{};
    navigator_.want(wanted_);
    enter(Mode::working, in);
    return;
  }
  waits_for_ = lifts_off_after(in);
  if (waits_for_ || may_drift_into_neighbours(in)) return;
  const double layer_m = kClimbLayerM * neighbours_after();
  top_W_ = Vector3d(p_W.x(), p_W.y(), p_W.z() + kLowestTopM + layer_m);
  steering.motion = Path{{{*top_W_, config_.climb_mps}}};
  steering.gimbal = GimbalCommand{GimbalMode::angle, 0.0, 0.0};
  climbed_m_ = p_W.z();
  stepped_aside_ = false;
  climbed_at_ = in.tick;
  enter(Mode::takeoff, in);
}

/// Number of UAVs with a higher index that start near by, from which each UAV derives a height of its own to climb to.
int FlightCore::neighbours_after() const {
  int count = 0;
  for (std::size_t uav = agent_.self + 1; uav < agent_.fleet.size(); ++uav) {
    if ((agent_.fleet[uav].p_WB_start - agent_.me().p_WB_start).norm() <= kCrowdM) ++count;
  }
  return count;
}

/// The order is: explorers first, then by index. @returns a UAV near by that comes before this one and is still at its
/// start; nullopt if there is none, or this UAV has waited long enough.
std::optional<std::size_t> FlightCore::lifts_off_after(const PlannerInput& in) {
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
bool FlightCore::may_drift_into_neighbours(const PlannerInput& in) {
  if (!drifts(in)) return false;
  bool clear =
      filter_.clear_up_to(agent_.me().p_WB_start.z() + kClearM, {in.tick, in.state, *in.world_map, in.boxes, in.peers});
  // A LiDAR on the ground does not see all the space above it, so an explorer may lift off into unproved space.
  clear = clear || (navigator_.sees() && filter_.held().by == Held::By::unproved);
  if (!clear && filter_.held().by == Held::By::peer) waits_for_ = filter_.held().peer;
  if (!clear && !waits_for_ && !navigator_.sees()) waits_for_ = agent_.first_explorer();
  return !clear;
}

/// Climbs as high as space is proved free, and begins to work where the climb ends. A UAV without a LiDAR that cannot
/// climb waits for an explorer. If positions drift, a UAV that is held before it has risen sinks to the ground again.
void FlightCore::take_off(const PlannerInput& in, Steering& steering) {
  const double height_m = in.tracking.setpoint.p_WB.z();
  if (height_m > climbed_m_ + kClimbGainM) {
    climbed_m_ = height_m;
    climbed_at_ = in.tick;
  }
  const double risen_m = drifts(in) && !navigator_.sees() ? kClearM : kRisenM;
  const bool risen = in.state.p_WB.z() > agent_.me().p_WB_start.z() + risen_m;
  const bool stalled = seconds(in.tick - climbed_at_) > config_.stall_s + config_.look_s;
  const double waits_s = config_.stall_s + (navigator_.sees() ? config_.look_s : 0.0);
  if (!risen && filter_.held().by == Held::By::structure && seconds(in.tick - climbed_at_) > config_.stall_s) {
    climb_aside(in, steering);
    return;
  }
  // The clearance for drift may reach an unproved cube right above the UAV, which its LiDAR never sees: step aside.
  const bool looked = navigator_.sees() && seconds(in.tick - climbed_at_) > config_.look_s;
  if (drifts(in) && !risen && looked && !stepped_aside_ && filter_.held().by == Held::By::unproved) {
    stepped_aside_ = true;
    climb_from(in.tracking.setpoint.p_WB + kStepAsideM * away_from_neighbours_W(in), in, steering);
    return;
  }
  if (drifts(in) && !risen && seconds(in.tick - climbed_at_) > waits_s) {
    filter_.set_trust(SafetyFilter::Trust::start);
    steering.motion = landing_.down_at(in.tracking.setpoint.p_WB, in);
    sinks_back_ = true;
    enter(Mode::ground, in);
    return;
  }
  if (in.tracking.done || (stalled && risen)) {
    steering.motion = Hold{};
    outcomes_.clear();
    navigator_.want(wanted_);
    enter(Mode::working, in);
    return;
  }
  if (stalled && !navigator_.sees()) waits_for_ = agent_.first_explorer();
}

/// Climbs at a place beside, farther from the structure that holds the UAV down.
void FlightCore::climb_aside(const PlannerInput& in, Steering& steering) {
  climbed_at_ = in.tick;
  const auto places_W = places_aside_W(in.state.p_WB, top_W_->z(), filter_.tube_m(0.0), *in.world_map);
  if (places_W.empty()) return;
  Vector3d place_W = places_W[next_aside_++ % places_W.size()];
  place_W.z() = std::max(place_W.z(), agent_.me().p_WB_start.z() + kLowAsideM);
  climb_from(place_W, in, steering);
}

/// Flies to a place, and climbs from there.
void FlightCore::climb_from(const Vector3d& place_W, const PlannerInput& in, Steering& steering) {
  climbed_at_ = in.tick;
  top_W_ = Vector3d(place_W.x(), place_W.y(), top_W_->z());
  steering.motion = Path{{{place_W, config_.tight_mps}, {*top_W_, config_.climb_mps}}};
}

/// Horizontal unit vector away from the other UAVs near by; the nearest ones count most.
Vector3d FlightCore::away_from_neighbours_W(const PlannerInput& in) const {
  Vector3d away_W = Vector3d::Zero();
  for (const Peer& peer : in.peers.all()) {
    Vector3d off_W = in.state.p_WB - peer.p_W;
    off_W.z() = 0.0;
    if (off_W.norm() > 0.0 && off_W.norm() <= kCrowdM) away_W += off_W.normalized() / off_W.squaredNorm();
  }
  return away_W.norm() > 0.0 ? Vector3d(away_W.normalized()) : Vector3d::UnitX();
}

/// The navigator's outcomes since the last call. Notes in no_way_ why a goal was not reached.
std::vector<Outcome> FlightCore::outcomes() {
  std::vector<Outcome> outcomes = navigator_.take_outcomes();
  for (const Outcome& outcome : outcomes) {
    if (outcome.kind != Outcome::Kind::reached) no_way_ = outcome.reason;
  }
  return outcomes;
}

void FlightCore::work(const PlannerInput& in, Steering& steering) {
  navigator_.step(in, filter_.held(), steering);
  for (Outcome& outcome : outcomes()) {
    if (outcome.kind != Outcome::Kind::no_way) recovery_.progress();
    outcomes_.push_back(std::move(outcome));
  }
  if (navigator_.current()) {
    since_ = in.tick;
    if (filter_.held().by == Held::By::peer) waits_for_ = filter_.held().peer;
  } else if (seconds(in.tick - since_) > kIdleS) {
    recovery_.begin(in);
    enter(Mode::recovering, in);
  }
}

/// @returns whether the UAV sets out to show a photographer the way up.
bool FlightCore::begin_showing(const PlannerInput& in) {
  if (in.tick < show_at_ || navigator_.on_way() || !navigator_.sees()) return false;
  show_at_ = in.tick + ticks(kShowCheckS);
  auto goal = showing_.next(in, navigator_.space(in));
  if (!goal) return false;
  navigator_.want({std::move(*goal)});
  enter(Mode::showing, in);
  return true;
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
    navigator_.want(wanted_);
    enter(Mode::working, in);
    return;
  }
  if (in.station_linked && homing_.delivers_here(in)) {
    navigator_.stop(steering);
    at_place_since_.reset();
    return;
  }
  navigator_.step(in, filter_.held(), steering);
  bool missed = false;
  for (const Outcome& outcome : outcomes()) {
    missed = outcome.kind != Outcome::Kind::reached;
    if (missed) continue;
    at_place_since_ = in.tick;
    recovery_.progress();
  }
  const bool shut_in = missed && filter_.held().by == Held::By::structure;
  if (!navigator_.idle() && !shut_in) return;
  if (missed) {
    navigator_.stop(steering);
    lost_way_home_ = true;
    recovery_.begin(in);
    enter(Mode::recovering, in);
    return;
  }
  if (at_place_since_ && seconds(in.tick - *at_place_since_) < kNoLinkS) return;
  at_place_since_.reset();
  const std::vector<Vector3d> places_W = homing_.places(in, navigator_.space(in));
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < places_W.size(); ++i) {
    const Vector3d& p_W = places_W[(i + next_place_) % places_W.size()];
    goals.push_back({.id = kHome, .way = {{p_W, config_.approach_mps}}});
  }
  ++next_place_;
  navigator_.want(std::move(goals));
}

}  // namespace skein::agent
