#include "uav_agent/flight/pilot.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/flight/path_search.hpp"

namespace skein::agent {
namespace {

constexpr double kLookAheadDtS = 0.25;  ///< of the predictions for safety and traffic
constexpr int kLookAheadCount = 13;
constexpr std::uint64_t kObstacleSteps = 4;  ///< exchanges between two looks at the map
constexpr double kStopSlackM = 0.4;          ///< the safety stop is this much less careful than planning
constexpr double kDriftDtS = 0.125;          ///< of where its velocity carries a UAV, whatever it was told
constexpr int kDriftCount = 4;               ///< no farther than it overshoots a corner that it brakes for
constexpr double kApproachM = 0.05;          ///< who is too near to something may come nearer by this, not more
constexpr double kClimbApproachM = 0.3, kClimbShare = 0.4;  ///< straight up beside a wall, as even as its cells are
constexpr double kStandsMps = 0.2;
constexpr double kElsewhereM = 1.0, kMostBackM = 0.2;
constexpr double kHoversM = 0.05;                ///< about its place
constexpr double kDetourAgainS = 20.0;           ///< a second meeting within this time is no accident
constexpr double kWatchM = 0.5, kWatchS = 12.0;  ///< no further than this for so long: something is wrong
constexpr double kCarefulMps = 2.0, kBesideBoxM = 2.0, kSeenStepM = 1.0;
constexpr double kTrailStepM = 1.0, kRetreatM = 10.0;
constexpr std::size_t kTrailCount = 100;

}  // namespace

FreeSpace Pilot::way_space(const PlannerInput& in, const FreeSpace::Config& space, const Vector3d& goal) const {
  FreeSpace::Config config = space;
  const Vector3d here = in.tracking.setpoint.p_WB;
  config.enter_near_W = {here, goal};
  return {config, in.boxes, in.map, separation_.keep_out(in.tick, here, in.peers)};
}

std::vector<Waypoint> Pilot::rest_of_path(const PlannerInput& in) const {
  if (paused_) return path_.waypoints;
  const std::size_t leg = std::min(in.tracking.leg, path_.waypoints.size());
  return {path_.waypoints.begin() + static_cast<std::ptrdiff_t>(leg), path_.waypoints.end()};
}

Situation Pilot::look_out(const PlannerInput& in, const FreeSpace::Config& space, bool may_detour, PlannerOutput& out) {
  if (leaves_trail_) add_to_trail(in.tracking.setpoint.p_WB);
  clearance_m_ = space.use_map ? std::optional(space.clearance_m) : std::nullopt;
  climbs_ = !may_detour;
  const Situation traffic = give_way(in, space, may_detour, out);
  if (traffic != Situation::flying_on) return traffic;
  const bool obstacle = refused_ || obstacle_ahead(in, rest_of_path(in));
  sets_out_ = false;
  if (obstacle) {
    stop(out);
    return Situation::obstacle;
  }
  return stands_still(in) ? Situation::stuck : Situation::flying_on;
}

Situation Pilot::give_way(const PlannerInput& in, const FreeSpace::Config& space, bool may_detour, PlannerOutput& out) {
  const std::vector<Waypoint> rest = rest_of_path(in);
  if (rest.empty()) return Situation::flying_on;
  // The others see where this UAV is, not what it was told: so does it.
  const auto ahead = positions_ahead(in.state.p_WB, rest, kLookAheadDtS, kLookAheadCount);
  switch (separation_.judge(in.tick, ahead, kLookAheadDtS, in.peers)) {
    case Traffic::clear:
      if (!paused_) return Situation::flying_on;
      set_out(std::move(path_), out);
      return Situation::waiting;
    case Traffic::wait:
      if (!paused_) {
        path_.waypoints = rest;
        paused_ = true;
        out.motion = Hold{};
      }
      return Situation::waiting;
    case Traffic::go_around:
      break;
  }
  // One detour is worth a try. If it led to nothing, the other UAV has work here: something else first.
  const bool again = detour_at_ && seconds(in.tick - *detour_at_) < kDetourAgainS;
  detour_at_ = in.tick;
  if (may_detour && !again && go_around(rest, in, space, out)) return Situation::detour;
  stop(out);
  return Situation::crowded;
}

/// Leaves the path for a way around whoever stands on it, and comes back to it behind them.
bool Pilot::go_around(const std::vector<Waypoint>& rest, const PlannerInput& in, const FreeSpace::Config& space,
                      PlannerOutput& out) {
  const FreeSpace way = way_space(in, space, rest.back().p_WB);
  std::size_t back = 0;
  while (back + 1 < rest.size() && !way.free(rest[back].p_WB)) ++back;
  const auto corners = find_path(way, in.boxes, in.tracking.setpoint.p_WB, rest[back].p_WB);
  if (!corners) return false;
  Path around = path_through(*corners, config_.speed_mps);
  around.waypoints.insert(around.waypoints.end(), rest.begin() + static_cast<std::ptrdiff_t>(back) + 1, rest.end());
  follow(std::move(around), in, out);
  return true;
}

/// @param rest  of the path.
bool Pilot::obstacle_ahead(const PlannerInput& in, const std::vector<Waypoint>& rest) {
  if (!clearance_m_ || (in.k % kObstacleSteps != 0 && !sets_out_) || rest.empty()) return false;
  // Whoever is too near to something already may still move away from it.
  const auto comes_too_near = [&](const std::vector<Vector3d>& ahead, double back_m) {
    double limit = *clearance_m_ - kStopSlackM;
    if (const auto now = in.map.distance_to_occupied(ahead.front(), limit)) {
      const double least_m = climbs_ ? std::max(kClimbShare * *clearance_m_, *now - kClimbApproachM)
                                     : least_on_way_out_m(*now, *clearance_m_, kApproachM);
      limit = std::max(0.0, std::min(least_m, *now) + back_m - kHoversM);
    }
    return std::any_of(ahead.begin() + 1, ahead.end(),
                       [&](const Vector3d& p) { return in.map.any_occupied_within(p, limit); });
  };
  const double back_m = climbs_ ? 0.0 : came_nearer_m(in, *clearance_m_ - kStopSlackM);
  // Both where it was told to go and where it is really going.
  const Vector3d demanded = in.tracking.setpoint.p_WB;
  if (comes_too_near(positions_ahead(demanded, rest, kLookAheadDtS, kLookAheadCount), back_m)) return true;
  std::vector<Vector3d> drift;
  for (int i = 0; i < kDriftCount; ++i) drift.push_back(in.state.p_WB + i * kDriftDtS * in.state.v_WB);
  return comes_too_near(drift, 0.0) || comes_too_near({in.state.p_WB, 0.5 * (in.state.p_WB + demanded), demanded}, 0.0);
}

/// Each attempt to leave a tight place may end a little nearer to what is there, and there are many. By how much it has
/// come nearer since it was farthest off, and has to move away now.
double Pilot::came_nearer_m(const PlannerInput& in, double limit_m) {
  const Vector3d here_W = in.state.p_WB;
  const auto now = in.map.distance_to_occupied(here_W, limit_m);
  const bool elsewhere = tight_at_W_ && (here_W - *tight_at_W_).norm() > kElsewhereM;
  if (!now || !tight_at_W_ || elsewhere) {
    tight_at_W_ = now ? std::optional(here_W) : std::nullopt;
    return 0.0;
  }
  const double there_m = in.map.distance_to_occupied(*tight_at_W_, limit_m).value_or(limit_m);
  if (*now > there_m) tight_at_W_ = here_W;
  return std::clamp(there_m - *now - kHoversM, 0.0, kMostBackM);
}

bool Pilot::stands_still(const PlannerInput& in) {
  const bool moved = (in.state.p_WB - watched_p_W_).norm() > kWatchM;
  if (moved || !has_path() || in.tracking.done) {
    watched_p_W_ = in.state.p_WB;
    watched_since_ = in.tick;
  }
  if (seconds(in.tick - watched_since_) < kWatchS) return false;
  watched_since_ = in.tick;
  return true;
}

/// Remembers where it was: what was free once is free now.
void Pilot::add_to_trail(const Vector3d& p_W) {
  if (!trail_.empty() && (trail_.back() - p_W).norm() < kTrailStepM) return;
  trail_.push_back(p_W);
  if (trail_.size() > kTrailCount) trail_.pop_front();
}

bool Pilot::retreat(const PlannerInput& in, PlannerOutput& out, bool leave_trail) {
  Path path;
  double length = 0.0;
  while (trail_.size() > 1 && length < kRetreatM) {
    const Vector3d from = trail_.back();
    trail_.pop_back();
    length += (trail_.back() - from).norm();
    path.waypoints.push_back({trail_.back(), config_.retreat_mps});
  }
  if (path.waypoints.empty()) return false;
  set_out(std::move(path), out);
  retreated_ = true;
  leaves_trail_ = leave_trail;
  look_before_leaving(in, out);
  return true;
}

void Pilot::follow(Path path, const PlannerInput& in, PlannerOutput& out) {
  missed_W_.reset();
  out.no_way.clear();
  slow_down_where_little_was_seen(in, path);
  set_out(std::move(path), out);
  retreated_ = false;
  leaves_trail_ = true;
  look_before_leaving(in, out);
}

/// Whoever stands does not leave towards what it will be stopped for: attempt by attempt it would come nearer to that.
void Pilot::look_before_leaving(const PlannerInput& in, PlannerOutput& out) {
  const bool stands = in.tracking.done && in.state.v_WB.norm() < kStandsMps;
  refused_ = stands && obstacle_ahead(in, path_.waypoints);  // tracking.leg is of the path before
  if (refused_) out.motion = Hold{};
}

void Pilot::set_out(Path path, PlannerOutput& out) {
  path_ = std::move(path);
  paused_ = false;
  sets_out_ = true;
  refused_ = false;
  out.motion = path_;
}

/// In and beside boxes, where less than all of the proof is there, a LiDAR sees at the last moment what is thin.
void Pilot::slow_down_where_little_was_seen(const PlannerInput& in, Path& path) {
  const auto beside_box = [&](const Vector3d& p_W) {
    return std::ranges::any_of(in.boxes, [&](const OrientedBox& box) { return box.contains(p_W, kBesideBoxM); });
  };
  Vector3d from_W = in.tracking.setpoint.p_WB;
  for (Waypoint& waypoint : path.waypoints) {
    const Vector3d way = waypoint.p_WB - from_W;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / kSeenStepM)));
    for (int i = 1; i <= steps && waypoint.speed_mps > kCarefulMps; ++i) {
      const Vector3d p_W = from_W + way * (static_cast<double>(i) / steps);
      if (beside_box(p_W) && !in.map.known_free(p_W, kProofRays)) waypoint.speed_mps = kCarefulMps;
    }
    from_W = waypoint.p_WB;
  }
}

void Pilot::stop(PlannerOutput& out) {
  path_.waypoints.clear();
  paused_ = false;
  refused_ = false;
  leaves_trail_ = true;
  out.motion = Hold{};
}

std::string Way::why() const {
  if (found) return "there is a way";
  if (gave_up) return "the search for a way gave up: it took too much effort";
  if (at_goal == Barrier::none) return "no way was found to a place that is free";
  return "the goal is " + std::string(to_string(at_goal));
}

Way Pilot::no_way(const Vector3d& goal, const FreeSpace& space, PlannerOutput& out, bool gave_up) {
  const Way none{.found = false, .at_goal = space.barrier(goal), .gave_up = gave_up};
  out.no_way = none.why();
  missed_W_ = goal;
  return none;
}

Way Pilot::fly_to(const Vector3d& goal, const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out) {
  const FreeSpace free_space = way_space(in, space, goal);
  bool gave_up = false;
  const auto corners = find_path(free_space, in.boxes, in.tracking.setpoint.p_WB, goal, {}, &gave_up);
  if (!corners) return no_way(goal, free_space, out, gave_up);
  follow(path_through(*corners, config_.speed_mps), in, out);
  return {};
}

bool Pilot::fly_nearer(const Vector3d& goal, double worth_m, const PlannerInput& in, const FreeSpace::Config& space,
                       PlannerOutput& out) {
  const auto corners = find_approach(way_space(in, space, goal), in.boxes, in.tracking.setpoint.p_WB, goal, worth_m);
  if (!corners) return false;
  follow(path_through(*corners, config_.speed_mps), in, out);
  return true;
}

}  // namespace skein::agent
