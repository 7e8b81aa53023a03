#include "sim_server/plan/schedule.hpp"

#include <algorithm>
#include <cmath>

#include "core/vehicle/airframe.hpp"
#include "sight/ray_shapes.hpp"

namespace skein::sim {
namespace {

constexpr double kPlanWaitStepS = 0.5;
constexpr int kMostWaits = 30;      ///< maximum number of wait steps before one leg
constexpr int kMostSkipped = 3;     ///< after more successive skipped views, the UAV gives up the view before them
constexpr double kLookStepS = 0.1;  ///< time step of the check of distances between UAVs
constexpr double kKeepApart = 0.8;  ///< between the surfaces of two bodies [m]
/// Time for the delivery of a report by radio, which takes some exchanges.
constexpr double kDeliveryS = 1.0;

}  // namespace

/// A flight from one stop to the next: its moves, and when the picture at the end has been taken.
struct Schedule::Trip {
  std::size_t view = 0;
  std::vector<PlanMove> moves;
  double done_s = 0.0;
};

PlanState plan_state(const TeamKind& kind, const std::vector<PlanMove>& moves, double t) {
  const auto later = std::ranges::upper_bound(moves, t, {}, &PlanMove::from_s);
  const PlanMove& move = later == moves.begin() ? *later : *(later - 1);
  const Vector3d way = move.to_W - move.from_W;
  const double length = way.norm();
  PlanState state{move.from_W, Vector3d::Zero(), Vector3d::Zero(), move.yaw, move.pitch};
  if (length <= 0.0) return state;
  const TeamKind::Motion motion = kind.motion(way, t - move.from_s);
  const Vector3d direction = way / length;
  state.p_WB += motion.distance * direction;
  state.v_WB = motion.speed * direction;
  state.a_WB = motion.acceleration * direction;
  return state;
}

Schedule::Schedule(Legs& legs, const Scenario& scenario, const Team& team, const std::vector<View>& views,
                   double settle_s, double end_s)
    : legs_(legs), scenario_(scenario), team_(team), views_(views), settle_s_(settle_s), end_s_(end_s) {
  for (const UavConfig& uav : scenario.fleet) {
    grounds_.emplace_back(uav.start.x(), uav.start.y(), rest_height(uav.vehicle));
  }
}

double Schedule::least_distance(const TeamKind& a, const TeamKind& b) {
  return Body(a.body).radius + Body(b.body).radius + kKeepApart;
}

PlanMove Schedule::takeoff(std::size_t uav) const {
  const Vector3d up = legs_.place(legs_.start_of(UavIndex{uav}));
  const double climb_s = kind_of(uav).travel_s(up - grounds_[uav]);
  return {kSpinUpS, kSpinUpS + climb_s, grounds_[uav], up, scenario_.fleet[UavIndex{uav}].start_yaw, 0.0, false};
}

/// Whether a UAV keeps its distance from the UAVs that were added before, and from those still on the ground. UAVs that
/// start close to each other need only 95 % of the distance of their starts.
bool Schedule::apart(std::size_t uav, const std::vector<PlanMove>& moves, double from_s, double until_s) const {
  for (double t = from_s;; t = std::min(until_s, t + kLookStepS)) {
    const Vector3d p_W = plan_state(kind_of(uav), moves, t).p_WB;
    for (std::size_t other = 0; other < grounds_.size(); ++other) {
      if (other == uav) continue;
      const bool moves_too = other < earlier_.size() && !earlier_[other].empty();
      const Vector3d q_W = moves_too ? plan_state(kind_of(other), earlier_[other], t).p_WB : grounds_[other];
      const double needed =
          std::min(least_distance(kind_of(uav), kind_of(other)), 0.95 * (grounds_[uav] - grounds_[other]).norm());
      if ((p_W - q_W).squaredNorm() < needed * needed) return false;
    }
    if (t >= until_s) return true;
  }
}

/// The result has no moves if there is no path: only successive stops of a route are sure to be connected, and after
/// skipped views a trip begins at an earlier stop.
Schedule::Trip Schedule::trip(const Trip& before, std::size_t from, std::size_t to) {
  const TeamKind& kind = team_.kinds[legs_.kind(to)];
  const View& view = views_[to];
  Trip next{to, {}, 0.0};
  Vector3d at = legs_.place(from);
  double t = before.done_s;
  for (const Vector3d& corner : legs_.way(from, to)) {
    const double until_s = t + kind.travel_s(corner - at);
    next.moves.push_back({t, until_s, at, corner, view.yaw, view.pitch, false});
    t = until_s;
    at = corner;
  }
  if (next.moves.empty()) return next;
  next.moves.back().picture = true;
  next.done_s = std::max(t, before.done_s + legs_.turn_s(from, to)) + settle_s_ + kPictureS;
  return next;
}

/// Delays a trip until its path is free, and its end is free for `stay_s`. @returns false if that fails.
/// @param trip  has moves
bool Schedule::leave(std::size_t uav, Trip& trip, double stay_s) const {
  const double ready_s = trip.moves.front().from_s;
  for (int i = 0; i <= kMostWaits; ++i) {
    if (apart(uav, trip.moves, ready_s, trip.done_s + stay_s)) return true;
    // The UAV can wait only while it is not in another UAV's way.
    const std::vector<PlanMove> waits = {trip.moves.front()};
    if (!apart(uav, waits, ready_s, trip.moves.front().from_s)) return false;
    for (PlanMove& move : trip.moves) {
      move.from_s += kPlanWaitStepS;
      move.until_s += kPlanWaitStepS;
    }
    trip.done_s += kPlanWaitStepS;
  }
  return false;
}

/// The moves from the last view to a place where its pictures are delivered; the UAV stays there until the end. nullopt
/// if there is no such place, if it is not free, or if the UAV would be too late.
std::optional<std::vector<PlanMove>> Schedule::home(std::size_t uav, const Trip& last, std::size_t view) {
  Trip way{view, {}, last.done_s};
  Vector3d at = legs_.place(view);
  for (const Vector3d& corner : legs_.tail(view)) {
    const double until_s = way.done_s + kind_of(uav).travel_s(corner - at);
    way.moves.push_back({way.done_s, until_s, at, corner, views_[view].yaw, views_[view].pitch, false});
    way.done_s = until_s;
    at = corner;
  }
  if (way.moves.empty()) {
    way.moves.push_back({way.done_s, way.done_s, at, at, views_[view].yaw, views_[view].pitch, false});
  }
  if (legs_.tail_s(view) >= kNever || !leave(uav, way, std::max(0.0, end_s_ - way.done_s))) return std::nullopt;
  if (way.done_s > end_s_) return std::nullopt;
  return way.moves;
}

Timetable Schedule::add(const Route& route) {
  const std::size_t uav = earlier_.size(), start = legs_.start_of(UavIndex{uav});
  std::vector<Trip> trips;
  Timetable table;
  if (!route.stops.empty()) {
    Trip first{start, {takeoff(uav)}, legs_.takeoff_s(UavIndex{uav})};
    if (leave(uav, first, 0.0)) trips.push_back(first);
  }
  int skipped = 0;
  for (std::size_t i = 0; i < route.stops.size() && !trips.empty(); ++i) {
    Trip next = trip(trips.back(), trips.back().view, route.stops[i]);
    if (!next.moves.empty() && leave(uav, next, 0.0) && next.done_s + legs_.tail_s(next.view) <= end_s_ - kDeliveryS) {
      trips.push_back(std::move(next));
      skipped = 0;
    } else if (++skipped > kMostSkipped && trips.size() > 1) {
      trips.pop_back();
      i -= static_cast<std::size_t>(kMostSkipped) + 1;  // the skipped views may be reachable from there
      skipped = 0;
    }
  }
  while (trips.size() > 1) {
    if (const auto home_moves = home(uav, trips.back(), trips.back().view)) {
      for (const Trip& done : trips) {
        std::ranges::copy(done.moves, std::back_inserter(table.moves));
        if (done.view != start) table.views.push_back(done.view);
      }
      std::ranges::copy(*home_moves, std::back_inserter(table.moves));
      table.time_s = home_moves->back().until_s;
      break;
    }
    trips.pop_back();
  }
  earlier_.push_back(table.moves);
  return table;
}

}  // namespace skein::sim
