#include "uav_agent/flight_core/navigator.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight_core/goal_ids.hpp"
#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

constexpr double kAheadM = 0.5;           ///< across; a place that is nearer gives no heading; chosen
constexpr int kSearchesPerExchange = 2;   ///< number of goals that are tried; chosen
constexpr int kMostExpansions = 4000;     ///< of one search; chosen: bounds its CPU time
constexpr double kGreedyHeuristic = 3.0;  ///< of the second search; chosen: a long path is better than none
/// Lattice of the second search, if the first one has no path out of a narrow place. Chosen: planners plan
/// on finer lattices than the first.
constexpr double kFineCellM = 1.0;
constexpr double kSearchAgainS = 0.5;   ///< pause after a search that found no path; chosen
constexpr std::uint64_t kLookEach = 4;  ///< exchanges between two checks of the path ahead; chosen
/// The path is checked up to kLookAheadM ahead. It may be nearer to structure by kSlackM than when it was planned.
/// Chosen.
constexpr double kLookAheadM = 15.0, kSlackM = 0.4;
constexpr double kBesideM = 0.1;          ///< a UAV this far beside its path counts as being on it; chosen
constexpr int kMostReplans = 3;           ///< after these, the goal ends; chosen
constexpr double kRefusedM = 1.5;         ///< radius of a place that paths avoid, because it held the UAV; chosen
constexpr std::size_t kMostRefused = 64;  ///< memory: the oldest place is dropped
constexpr double kPeersM = 15.0;          ///< paths avoid UAVs up to this distance; chosen
constexpr double kTurn = 0.8, kTurnEveryS = 1.2;  ///< steps of looking around [rad]; chosen
constexpr double kFaceM = 4.0;   ///< nearer than this to its goal, a UAV turns to the goal's yaw; chosen
constexpr double kHereM = 0.3;   ///< places this near to each other are the same; chosen
constexpr double kFitMps = 1.0;  ///< paths are wide enough for this speed; chosen

/// Whether all places within kBesideM of p are nearer to structure than this. The map has one distance for each cube,
/// and a path may lead along the border of two cubes: beside the path, the distance may be less than where it was
/// planned.
bool all_nearer_than(double distance_m, const Vector3d& p_W, const WorldMap& map) {
  if (map.structure_distance_m(p_W) >= distance_m) return false;
  for (int corner = 0; corner < kCubeCorners; ++corner) {
    const Vector3d beside = kBesideM * (2 * corner_step(corner).array() - 1).matrix().cast<double>();
    if (map.structure_distance_m(p_W + beside) >= distance_m) return false;
  }
  return true;
}

}  // namespace

Navigator::Navigator(const FlightConfig& config, const AgentConfig& agent, const SafetyFilter& filter)
    : config_(config), agent_(agent), filter_(filter), fit_(filter.tube_m(kFitMps), config.ground_m), sight_(agent) {}

void Navigator::update(const PlannerInput& in) {
  fit_.set(filter_.tube_m(kFitMps), filter_.ground_m());
  fit_.update(*in.world_map, in.tick);
  sight_.update(in);
}

FreeSpace::Config Navigator::space_config(const PlannerInput& in) const {
  FreeSpace::Config config;
  config.clearance_m = filter_.tube_m(kFitMps);
  config.jut_m = 0.0;
  config.floor_m = std::min(config_.floor_m, std::max(in.tracking.setpoint.p_WB.z(), 0.5 * config_.floor_m));
  config.world = in.world_map;
  config.fit = &fit_;
  config.unknown_cost = config_.unknown_cost;
  config.blind_fleet = filter_.assumes_boxes();
  config.way_out_W = filter_.way_out_W(in.boxes);
  config.proved_only = !sees() && !filter_.assumes_boxes() && filter_.trust() == SafetyFilter::Trust::proved;
  return config;
}

/// @param here_W  start of the path. Spheres to keep out of shrink until here_W is outside.
FreeSpace Navigator::space(const PlannerInput& in, const Vector3d& here_W) const {
  std::vector<Sphere> keep_out;
  for (const Peer& peer : in.peers.all()) {
    const double off_m = (peer.p_W - here_W).norm();
    if (!peer.seen || off_m > kPeersM || seconds(in.tick - *peer.seen) > config_.peer_memory_s) continue;
    const double apart_m = filter_.apart_m(peer.uav, kFitMps);
    keep_out.push_back({peer.p_W, std::min(apart_m + kHereM, off_m - kHereM)});
  }
  for (const Refused& refused : refused_) {
    if (in.tick < refused.until) {
      keep_out.push_back({refused.p_W, std::min(kRefusedM, (refused.p_W - here_W).norm() - kHereM)});
    }
  }
  return {space_config(in), in.boxes, in.map, std::move(keep_out)};
}

/// The start of a path: the setpoint, or a place a step back from another UAV that is so near that the safety filter
/// would not let this UAV fly around it.
Vector3d Navigator::way_begins_W(const PlannerInput& in) const {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  Vector3d from_W = here_W;
  for (const Peer& peer : in.peers.all()) {
    const double off_m = (here_W - peer.p_W).norm();
    const double apart_m = filter_.apart_m(peer.uav, kFitMps, here_W - peer.p_W);
    const double back_m = apart_m + 2.0 * kHereM - off_m;
    if (!peer.visible || back_m <= 0.0 || off_m <= 0.0) continue;
    from_W += (here_W - peer.p_W) / off_m * back_m;
  }
  return from_W != here_W && space(in).segment_free(here_W, from_W) ? from_W : here_W;
}

std::optional<Vector3d> Navigator::going_to_W() const {
  if (!current_) return missed_W_;
  return on_way_ ? current_->way.back().p_WB : current_->way.front().p_WB;
}

void Navigator::want(std::vector<Goal> goals) {
  std::erase_if(goals, [](const Goal& goal) { return goal.way.empty(); });
  if (current_ && !goals.empty() && goals.front().id == current_->id) {
    current_ = std::move(goals.front());
    goals.erase(goals.begin());
    new_way_ = true;
    retraces_ = false;
  } else {
    current_.reset();
  }
  goals_ = std::move(goals);
}

void Navigator::retrace(std::vector<Waypoint> trail) {
  goals_.clear();
  current_ = Goal{.id = goal_ids::kTrail, .way = std::move(trail)};
  on_way_ = new_way_ = retraces_ = true;
}

void Navigator::stop(Steering& steering) {
  if (current_ || !path_.empty()) steering.motion = Hold{};
  current_.reset();
  goals_.clear();
  path_.clear();
  on_way_ = false;
  pace_mps_ = std::numeric_limits<double>::infinity();
}

void Navigator::give_up(const std::string& reason, Steering& steering) {
  if (current_) end(on_way_ ? Outcome::Kind::blocked : Outcome::Kind::no_way, reason, steering);
  stop(steering);
}

void Navigator::step(const PlannerInput& in, const Held& held, Steering& steering) {
  if (!current_) {
    if (!path_.empty()) {
      steering.motion = Hold{};
      path_.clear();
    }
    choose(in, steering);
    return;
  }
  if (new_way_) {
    new_way_ = false;
    if (on_way_) {
      fly(current_->way, steering);
      leg_ = 0;
      if (!retraces_) return;
      gained_p_W_ = in.tracking.setpoint.p_WB;
      gained_at_ = in.tick;
      return;
    }
    const bool moved = (path_.back().p_WB - current_->way.front().p_WB).norm() > kHereM;
    if (moved && set_out(in, steering) != Search::found) end(Outcome::Kind::no_way, "no way", steering);
    if (moved) return;
  }
  if (in.tracking.done && !on_way_) {
    begin_way(in, steering);
    return;
  }
  if (in.tracking.done) {
    end(Outcome::Kind::reached, "", steering);
    return;
  }
  if (on_way_) leg_ = in.tracking.leg;
  if (!sees()) pace_mps_ = std::numeric_limits<double>::infinity();
  if (in.k % kLookEach == 0 && sees()) {
    pace_mps_ = std::max(kCreepMps, proved_ahead_m(in, config_.approach_mps * config_.ahead_s) / config_.ahead_s);
  }
  if (in.k % kLookEach == 0 && !retraces_ && blocked_ahead(in)) {
    replan(in, "something was seen on the way", steering);
    return;
  }
  watch(in, held, steering);
}

void Navigator::choose(const PlannerInput& in, Steering& steering) {
  if (in.tick < search_at_) return;
  for (int searches = 0; searches < kSearchesPerExchange && !goals_.empty(); ++searches) {
    current_ = std::move(goals_.front());
    goals_.erase(goals_.begin());
    on_way_ = new_way_ = retraces_ = false;
    leg_ = 0;
    replans_ = 0;
    gained_p_W_ = in.tracking.setpoint.p_WB;
    gained_at_ = in.tick;
    const Search search = set_out(in, steering);
    if (search == Search::found) return;
    search_at_ = in.tick + ticks(kSearchAgainS);
    end(Outcome::Kind::no_way, search == Search::gave_up ? "the search for a way took too long" : "no way", steering);
  }
}

/// Searches a path to the first waypoint of the current goal, and begins to fly along it.
Navigator::Search Navigator::set_out(const PlannerInput& in, Steering& steering) {
  const PartTimer timer(in.parts, "flight/searches");
  const Vector3d from_W = in.tracking.setpoint.p_WB, to_W = current_->way.front().p_WB;
  steering.gimbal = current_->gimbal;
  if ((to_W - from_W).norm() < kHereM) {
    begin_way(in, steering);
    return Search::found;
  }
  bool gave_up = false;
  const Vector3d begin_W = way_begins_W(in);
  const FreeSpace space = this->space(in, begin_W);
  PathSearchConfig search{.max_expansions = kMostExpansions};
  auto corners = find_path(space, in.boxes, begin_W, to_W, search, &gave_up);
  if (!corners) {
    if (!gave_up) search.cell_m = kFineCellM;
    search.heuristic = kGreedyHeuristic;
    corners = find_path(space, in.boxes, begin_W, to_W, search, &gave_up);
  }
  if (!corners) return gave_up ? Search::gave_up : Search::none;
  std::vector<Waypoint> waypoints = path_through(*corners, config_.approach_mps).waypoints;
  if (begin_W != from_W) waypoints.insert(waypoints.begin(), {begin_W, config_.approach_mps});
  on_way_ = false;
  fly(std::move(waypoints), steering);
  face_ahead(in, steering);
  return Search::found;
}

void Navigator::begin_way(const PlannerInput& in, Steering& steering) {
  on_way_ = true;
  leg_ = 0;
  if (current_->yaw) steering.yaw = current_->yaw;
  fly(current_->way, steering);
  gained_p_W_ = in.tracking.setpoint.p_WB;
  gained_at_ = in.tick;
}

void Navigator::fly(std::vector<Waypoint> waypoints, Steering& steering) {
  path_ = std::move(waypoints);
  steering.motion = Path{path_};
}

void Navigator::end(Outcome::Kind kind, std::string reason, Steering& steering) {
  if (kind == Outcome::Kind::no_way) missed_W_ = current_->way.front().p_WB;
  if (kind == Outcome::Kind::reached) missed_W_.reset();
  outcomes_.push_back({current_->id, kind, on_way_ ? leg_ : 0, std::move(reason)});
  if (kind != Outcome::Kind::reached && !path_.empty()) steering.motion = Hold{};
  path_.clear();
  current_.reset();
  on_way_ = false;
}

/// Refuses a place somewhat ahead of p on the path: p itself may be where the UAV is.
void Navigator::refuse(const Vector3d& p_W, const PlannerInput& in) {
  std::erase_if(refused_, [&](const Refused& refused) { return refused.until <= in.tick; });
  const Vector3d next_W = path_.empty() ? p_W : path_[std::min(in.tracking.leg, path_.size() - 1)].p_WB;
  const Vector3d ahead = next_W - p_W;
  const double off_m = ahead.norm();
  refused_.push_back({off_m > 0.0 ? Vector3d(p_W + ahead / off_m * std::min(off_m, kRefusedM)) : p_W,
                      in.tick + ticks(config_.refused_s)});
  if (refused_.size() > kMostRefused) refused_.pop_front();
}

/// Whether structure is in the way that was discovered after the path was planned.
bool Navigator::blocked_ahead(const PlannerInput& in) const {
  const PartTimer timer(in.parts, "flight/looks ahead");
  Vector3d at_W = in.tracking.setpoint.p_WB;
  // A UAV that is already nearer to structure may fly on, as long as its path comes no nearer.
  const double least_m = std::min(filter_.tube_m(0.0) - kSlackM, in.world_map->structure_distance_m(at_W));
  double length_m = 0.0;
  for (std::size_t i = in.tracking.leg; i < path_.size() && length_m < kLookAheadM; ++i) {
    const Vector3d leg = path_[i].p_WB - at_W;
    const int steps = std::max(1, static_cast<int>(std::ceil(leg.norm())));
    for (int j = 1; j <= steps; ++j) {
      const Vector3d p_W = at_W + leg * (static_cast<double>(j) / steps);
      if (all_nearer_than(least_m, p_W, *in.world_map)) return true;
    }
    length_m += leg.norm();
    at_W = path_[i].p_WB;
  }
  return false;
}

/// Length of the path ahead that is proved free, at most most_m [m].
double Navigator::proved_ahead_m(const PlannerInput& in, double most_m) const {
  const PartTimer timer(in.parts, "flight/looks ahead");
  Vector3d at_W = in.tracking.setpoint.p_WB;
  double length_m = 0.0;
  for (std::size_t i = in.tracking.leg; i < path_.size(); ++i) {
    const Vector3d leg = path_[i].p_WB - at_W;
    const int steps = std::max(1, static_cast<int>(std::ceil(leg.norm() / kProvedStepM)));
    for (int j = 1; j <= steps; ++j) {
      if (length_m > most_m) return most_m;
      if (!filter_.proved(at_W + leg * (static_cast<double>(j) / steps), *in.world_map, in.boxes)) return length_m;
      length_m += leg.norm() / steps;
    }
    at_W = path_[i].p_WB;
  }
  return most_m;
}

/// Searches another path to the goal's first waypoint. Along Goal::way there is no other path: the goal ends as
/// blocked, and the planner decides.
void Navigator::replan(const PlannerInput& in, const std::string& reason, Steering& steering) {
  if (on_way_) {
    end(Outcome::Kind::blocked, reason, steering);
    return;
  }
  if (++replans_ > kMostReplans || set_out(in, steering) != Search::found) {
    end(Outcome::Kind::no_way, reason, steering);
  }
}

void Navigator::watch(const PlannerInput& in, const Held& held, Steering& steering) {
  if ((in.tracking.setpoint.p_WB - gained_p_W_).norm() > kStaysM) {
    gained_p_W_ = in.tracking.setpoint.p_WB;
    gained_at_ = in.tick;
  }
  if (seconds(in.tick - gained_at_) > config_.stall_s) {
    stalled(in, held, steering);
  } else if (!on_way_ || !current_->yaw) {
    face_ahead(in, steering);
  }
}

void Navigator::look_around(const PlannerInput& in, Steering& steering) {
  if (!sees() || in.tick < turn_at_) return;
  steering.yaw = wrap_angle(in.tracking.setpoint.yaw + kTurn);
  turn_at_ = in.tick + ticks(kTurnEveryS);
}

void Navigator::stalled(const PlannerInput& in, const Held& held, Steering& steering) {
  const double since_s = seconds(in.tick - gained_at_);
  if (held.by == Held::By::peer) {
    // The UAV with the lower index replans first. The other one waits, and replans if that does not help.
    if (*held.peer < agent_.self && since_s < config_.stall_s + config_.yield_s) return;
    gained_at_ = in.tick;
    replan(in, "another UAV stays in the way", steering);
    return;
  }
  if (held.by == Held::By::unproved && since_s < config_.stall_s + config_.look_s) {
    look_around(in, steering);
    return;
  }
  if (held.by != Held::By::nothing) refuse(held.at_W, in);
  gained_at_ = in.tick;
  replan(in, held.by == Held::By::structure ? "too near to structure" : "not proved to be free", steering);
}

/// Turns the UAV to the goal's yaw near the goal, else along the path: a LiDAR proves most space along the body's x
/// axis, about which its servo turns.
void Navigator::face_ahead(const PlannerInput& in, Steering& steering) const {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  const bool near = (path_.back().p_WB - here_W).norm() < kFaceM;
  if (near && current_->yaw) {
    steering.yaw = current_->yaw;
    return;
  }
  if (!sees()) return;
  const std::size_t leg = std::min(in.tracking.leg, path_.size() - 1);
  const Vector3d ahead = path_[leg].p_WB - here_W;
  if (ahead.head<2>().norm() > kAheadM) steering.yaw = std::atan2(ahead.y(), ahead.x());
}

}  // namespace skein::agent
