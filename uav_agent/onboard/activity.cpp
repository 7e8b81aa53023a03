#include "uav_agent/onboard/activity.hpp"

namespace skein::agent {
namespace {

using What = Doing::What;

constexpr double kGoalMoved_m = 0.5;  ///< a goal that has moved by no more is still the same; chosen
constexpr double kBetween_s = 0.5;    ///< a shorter time without a goal counts as a change of goals; chosen
constexpr double kMateBreak_s = 0.5;  ///< longest break within one wait, as in Agent::waits(); chosen
constexpr double kNoWayTold_s = 1.0;  ///< least time for which a reason is reported; chosen
constexpr double kStands_mps = 0.3;   ///< a slower UAV stands; chosen
constexpr double kHere_m = 0.7;       ///< a UAV this near to its goal is there; chosen
constexpr double kStandsFor_s = 1.0;  ///< a standstill of at least this long is reported; chosen

bool is_between(const ActivityFacts& facts) {
  const auto* doing = std::get_if<Doing>(&facts.what);
  return doing != nullptr && (doing->what == What::seeks_way || doing->what == What::no_goal);
}

/// Whether the UAV is on its way somewhere; without a flight core always true.
bool is_on_its_way(const ActivityFacts& facts) {
  const auto* doing = std::get_if<Doing>(&facts.what);
  return doing == nullptr || doing->what == What::takeoff || doing->what == What::to_goal ||
         doing->what == What::along_goal || doing->what == What::shows_mate || doing->what == What::homing ||
         doing->what == What::delivers || doing->what == What::lands;
}

std::optional<Vector3d> goal_of(const ActivityFacts& facts) {
  const auto* doing = std::get_if<Doing>(&facts.what);
  return doing != nullptr ? doing->goal_W : std::get<OwnMotion>(facts.what).end_W;
}

const char* words_for(OwnMotion::Kind kind) {
  switch (kind) {
    case OwnMotion::Kind::none:
      return "on the ground";
    case OwnMotion::Kind::setpoint:
      return "flies to a set-point";
    case OwnMotion::Kind::path:
      return "flies along a path";
    case OwnMotion::Kind::hold:
      return "holds its place";
    case OwnMotion::Kind::command:
      return "sends commands of its own";
  }
  return "";
}

const char* words_for(What what) {
  switch (what) {
    case What::ground:
      return "on the ground";
    case What::takeoff:
      return "takes off";
    case What::awaits_way_up:
      return "waits to be shown its way up";
    case What::to_goal:
      return "flies to a goal";
    case What::along_goal:
      return "flies along a line";
    case What::seeks_way:
      return "looks for a way";
    case What::no_goal:
      return "has no goal";
    case What::shows_mate:
      return "shows another UAV its way up";
    case What::looks_round:
      return "looks around";
    case What::approaches:
      return "flies nearer to the goal that it missed";
    case What::elsewhere:
      return "tries to reach its goal from another place";
    case What::climbs:
      return "climbs to see more";
    case What::back:
      return "flies back the way it came";
    case What::makes_room:
      return "makes room for another UAV";
    case What::homing:
      return "returns to the station's sight";
    case What::delivers:
      return "delivers";
    case What::lands:
      return "flies to its landing place and lands: its battery is low";
    case What::awaits_link:
      return "waits for a link to the station";
  }
  return "";
}

const char* words_for(Held::By by) {
  switch (by) {
    case Held::By::nothing:
      return "";
    case Held::By::unproved:
      return "stands: what is ahead is not proved to be free";
    case Held::By::structure:
      return "stands: too near to structure";
    case Held::By::peer:
      return "stands: another UAV is in the way";
  }
  return "";
}

bool is_long(const std::optional<Tick>& since, Tick now) { return since && seconds(now - *since) >= kStandsFor_s; }

bool is_other_goal(const std::optional<Vector3d>& a, const std::optional<Vector3d>& b) {
  if (a.has_value() != b.has_value()) return true;
  return a && !((*a - *b).norm() <= kGoalMoved_m);
}

}  // namespace

std::string ActivityTeller::name_of(const std::optional<std::size_t>& uav) const {
  return uav && *uav < fleet_.size() ? fleet_[*uav].name : "";
}

std::string ActivityTeller::mode_of(const ActivityFacts& facts) const {
  if (const auto* own = std::get_if<OwnMotion>(&facts.what)) {
    return words_for(own->kind == OwnMotion::Kind::path && !own->end_W ? OwnMotion::Kind::hold : own->kind);
  }
  const Doing& doing = std::get<Doing>(facts.what);
  if (rests_) return "rests at its goal";
  if (held_) return words_for(facts.held.by);
  if (doing.what == What::shows_mate && !name_of(doing.mate).empty()) {
    return "shows " + name_of(doing.mate) + " its way up";
  }
  if (doing.what == What::delivers && facts.undelivered == 0) return "stays within the station's line of sight";
  return words_for(doing.what);
}

/// Notes whether the UAV has stood still for a while: at its goal, or because the safety filter stops it.
void ActivityTeller::note_standstill(const ActivityFacts& facts) {
  rests_ = held_ = false;
  const auto* doing = std::get_if<Doing>(&facts.what);
  if (doing == nullptr) return;
  const bool slow = facts.speed_mps < kStands_mps, same = doing->what == before_;
  before_ = doing->what;
  if (!slow) slow_since_.reset();
  if (slow && !slow_since_) slow_since_ = facts.tick;
  const bool to_goal = doing->what == What::to_goal || doing->what == What::along_goal;
  if (to_goal) last_goal_W_ = doing->goal_W;
  const bool here = last_goal_W_ && (facts.p_WB - *last_goal_W_).norm() <= kHere_m;
  rests_ = here && is_long(slow_since_, facts.tick) &&
           (to_goal || (doing->what == What::no_goal && facts.no_way.empty() && now_.no_way.empty()));
  const bool held = slow && same && is_on_its_way(facts) && doing->goal_W && facts.held.by != Held::By::nothing;
  if (!held) held_since_.reset();
  if (held && !held_since_) held_since_ = facts.tick;
  held_ = !rests_ && is_long(held_since_, facts.tick);
}

void ActivityTeller::note_waiting(const ActivityFacts& facts) {
  std::optional<std::size_t> mate = facts.waits_for;
  if (!mate && held_ && facts.held.by == Held::By::peer) mate = facts.held.peer;
  if (mate) {
    waits_for_ = mate;
    waited_at_ = facts.tick;
  } else if (seconds(facts.tick - waited_at_) > kMateBreak_s) {
    waits_for_.reset();
  }
  now_.waits_for = name_of(waits_for_);
}

/// Notes why there is no path. The reason is reported until the UAV is on its way again.
void ActivityTeller::note_no_way(const ActivityFacts& facts) {
  if (!facts.no_way.empty()) {
    now_.no_way = facts.no_way;
    no_way_at_ = facts.tick;
  } else if (is_on_its_way(facts) && seconds(facts.tick - no_way_at_) > kNoWayTold_s) {
    now_.no_way.clear();
  }
}

std::optional<Activity> ActivityTeller::step(const ActivityFacts& facts) {
  note_standstill(facts);
  note_waiting(facts);
  note_no_way(facts);
  if (!is_between(facts)) between_since_.reset();
  if (is_between(facts) && !between_since_) between_since_ = facts.tick;
  if (!told_ || !between_since_ || rests_ || seconds(facts.tick - *between_since_) > kBetween_s) {
    now_.mode = mode_of(facts);
    if (const auto goal_W = rests_ ? last_goal_W_ : goal_of(facts); is_other_goal(goal_W, now_.goal_W))
      now_.goal_W = goal_W;
  }
  now_.speed_mps = facts.speed_mps;
  now_.undelivered = static_cast<std::uint32_t>(facts.undelivered);
  const bool changed = !told_ || told_->mode != now_.mode || told_->goal_W != now_.goal_W ||
                       told_->waits_for != now_.waits_for || told_->no_way != now_.no_way;
  if (!changed && facts.tick < due_) return std::nullopt;
  told_ = now_;
  due_ = facts.tick + kTicksPerSecond;
  return now_;
}

}  // namespace skein::agent
