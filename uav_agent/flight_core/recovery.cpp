#include "uav_agent/flight_core/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight_core/goal_ids.hpp"
#include "uav_agent/flight_core/place_near.hpp"

namespace skein::agent {
namespace {

/// Least approach to the missed goal, way back, or way away, that is worth the flight. Chosen.
constexpr double kWorthM = 3.0;
constexpr int kExpansions = 2000;                      ///< of a search; chosen: bounds its CPU time
constexpr double kClimbM = 5.0;                        ///< height of a climb; chosen
constexpr double kElsewhereM[] = {8.0, 14.0};          ///< distances of other places; chosen
constexpr double kHeightsM[] = {3.0, 0.0, -3.0, 8.0};  ///< of other places, above the UAV, in this order; chosen
/// Directions of other places; the first one turns by kHeadingStep from one try to the next. Chosen; the step has no
/// divisor in common with kHeadings, so each direction comes first in turn.
constexpr int kHeadings = 8, kHeadingStep = 3;
constexpr double kLongestS = 30.0;  ///< longest flight of one behaviour; chosen
/// Between two places of the trail, and the length of the first way back along it. Chosen.
constexpr double kTrailStepM = 1.0, kBackM = 8.0;
constexpr double kMoreRoomM = 0.3;  ///< least gain of distance from structure that is worth a flight aside; chosen
/// No trail leads lower beside structure: a UAV finds no path from the ground there. Chosen.
constexpr double kTrailLowestM = 1.2, kBesideStructureM = 3.0;
constexpr std::size_t kLongestTrail = 192;  ///< memory: the oldest place is dropped

}  // namespace

Recovery::Recovery(const FlightConfig& config, SafetyFilter& filter, Navigator& navigator)
    : config_(config), filter_(filter), navigator_(navigator) {}

void Recovery::update(const PlannerInput& in) {
  if (!in.tracking.airborne) return;
  const Vector3d& here_W = in.tracking.setpoint.p_WB;
  if (here_W.z() < kTrailLowestM && in.world_map->structure_distance_m(here_W) < kBesideStructureM) {
    return trail_W_.clear();
  }
  const auto here = [&](const Vector3d& p_W) { return (here_W - p_W).norm() < kTrailStepM; };
  const auto before = std::ranges::find_if(trail_W_, here);
  if (before != trail_W_.end()) {
    trail_W_.erase(before + 1, trail_W_.end());
    return;
  }
  trail_W_.push_back(here_W);
  if (trail_W_.size() > kLongestTrail) trail_W_.pop_front();
}

void Recovery::progress(const PlannerInput& in) {
  if ((in.tracking.setpoint.p_WB - begun_W_).norm() >= kWorthM) tries_ = backs_ = 0;
}

void Recovery::begin(const PlannerInput& in, const Held& held) {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  const bool stayed = (here_W - begun_W_).norm() < kStaysM;
  begun_W_ = here_W;
  if (!navigator_.open_space(in).free(here_W)) {
    // Structure discovered meanwhile may be in the way back, too.
    const bool fails = behaviour_ == Behaviour::back && stayed;
    behaviour_ = fails && go_aside(in) ? Behaviour::aside : Behaviour::back;
    if (behaviour_ == Behaviour::aside || go_back(here_W)) {
      until_ = in.tick + ticks(kLongestS);
      return;
    }
  }
  for (int i = 0; i < kBehaviours; ++i) {
    behaviour_ = kOrder[tries_++ % kBehaviours];
    const bool stays = behaviour_ == Behaviour::look_around || behaviour_ == Behaviour::approach;
    if (held.by == Held::By::peer && stays) continue;
    if (behaviour_ == Behaviour::look_around) {
      // A UAV without a LiDAR waits, which gives UAVs with one the time to look.
      until_ = in.tick + ticks(navigator_.sees() ? config_.look_s : 0.5 * config_.look_s);
      return;
    }
    if (set_out(in)) {
      until_ = in.tick + ticks(kLongestS);
      return;
    }
  }
  until_ = in.tick + ticks(config_.stall_s);
}

/// Sets the behaviour's goal. @returns whether there is one.
bool Recovery::set_out(const PlannerInput& in) {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  const FreeSpace space = navigator_.space(in);
  if (behaviour_ == Behaviour::approach) {
    if (!navigator_.missed_W()) return false;
    const auto corners =
        find_approach(space, in.boxes, here_W, *navigator_.missed_W(), kWorthM, {.max_expansions = kExpansions});
    if (!corners) return false;
    navigator_.want({{.id = goal_ids::kRecovery, .way = {{corners->back(), config_.approach_mps}}}});
    return true;
  }
  if (behaviour_ == Behaviour::climb) {
    const Vector3d up_W = here_W + Vector3d(0.0, 0.0, kClimbM);
    if (!space.segment_free(here_W, up_W)) return false;
    navigator_.want({{.id = goal_ids::kRecovery, .way = {{up_W, config_.climb_mps}}}});
    return true;
  }
  if (behaviour_ == Behaviour::back) return go_back(here_W);
  for (const double distance_m : kElsewhereM) {
    for (int i = 0; i < kHeadings; ++i) {
      const double heading = 2.0 * std::numbers::pi * ((i + kHeadingStep * tries_) % kHeadings) / kHeadings;
      for (const double height_m : kHeightsM) {
        const Vector3d p_W =
            here_W + Vector3d(distance_m * std::cos(heading), distance_m * std::sin(heading), height_m);
        if (in.world_map->at(p_W) == Space::free && space.free(p_W) && space.segment_free(here_W, p_W)) {
          navigator_.want({{.id = goal_ids::kRecovery, .way = {{p_W, config_.approach_mps}}}});
          return true;
        }
      }
    }
  }
  return false;
}

/// Flies back along the UAV's own trail, since a search on a lattice may find no path out of a place that is only just
/// wide enough. Each time since progress(), the UAV flies back farther. @returns whether the trail is long enough.
bool Recovery::go_back(const Vector3d& here_W) {
  const double least_m = kBackM * (1 + backs_++);
  const auto far = [&](const Vector3d& p_W) { return (p_W - here_W).norm() >= least_m; };
  auto last = std::find_if(trail_W_.rbegin(), trail_W_.rend(), far);
  if (last == trail_W_.rend()) {
    if (trail_W_.empty() || (trail_W_.front() - here_W).norm() < kWorthM) return false;
    --last;
  }
  std::vector<Waypoint> trail;
  for (auto p_W = trail_W_.rbegin(); p_W <= last; ++p_W) trail.push_back({*p_W, config_.approach_mps});
  navigator_.retrace(std::move(trail));
  return true;
}

/// Flies straight to where structure is farther away, which needs no path. Forgets the trail, along which the UAV does
/// not get back. @returns whether there is such a place.
bool Recovery::go_aside(const PlannerInput& in) {
  const Vector3d& here_W = in.tracking.setpoint.p_WB;
  const double enough_m = filter_.tube_m(config_.approach_mps);
  const auto room_m = [&](const Vector3d& p_W) { return std::min(in.world_map->structure_distance_m(p_W), enough_m); };
  const auto p_W = best_place_near_W(here_W, config_.floor_m, room_m(here_W) + kMoreRoomM, room_m, filter_,
                                     {in.tick, in.state, *in.world_map, in.boxes, in.peers});
  if (!p_W) return false;
  trail_W_.clear();
  navigator_.retrace({{*p_W, config_.tight_mps}});
  return true;
}

bool Recovery::step(const PlannerInput& in, const Held& held, Steering& steering) {
  if (behaviour_ == Behaviour::look_around) {
    navigator_.look_around(in, steering);
    return in.tick >= until_;
  }
  navigator_.step(in, held, steering);
  const bool over = navigator_.idle() || in.tick >= until_;
  if (over) navigator_.stop(steering);
  navigator_.take_outcomes();
  return over;
}

Doing::What Recovery::doing() const {
  switch (behaviour_) {
    case Behaviour::look_around:
      return Doing::What::looks_round;
    case Behaviour::approach:
      return Doing::What::approaches;
    case Behaviour::elsewhere:
    case Behaviour::aside:
      return Doing::What::elsewhere;
    case Behaviour::climb:
      return Doing::What::climbs;
    case Behaviour::back:
      return Doing::What::back;
  }
  return Doing::What::looks_round;
}

}  // namespace skein::agent
