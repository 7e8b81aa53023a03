// Patrol: flies along every face of every box in strips, at the distance where the camera is sharp. It knows the boxes and its
// own map, talks to nobody, and is meant as an honest baseline: simple, safe, the same on every UAV.
//
// In turn: lift off straight up, each UAV to a height of its own; explorers fly once around everything; then each UAV flies
// its share of the strips (strips.hpp), closing in on the real surface as the map fills (standoff.hpp), goes to where the
// station sees it from time to time and in good time before the end (delivery.hpp), and begins its share again with the
// camera turned a little. Whatever it does, it stops before anything that the map shows in its way, and gives way.
#include <algorithm>
#include <cmath>
#include <deque>

#include "core/euler.hpp"
#include "uav_agent/delivery.hpp"
#include "uav_agent/free_space.hpp"
#include "uav_agent/path_search.hpp"
#include "uav_agent/planner.hpp"
#include "uav_agent/separation.hpp"
#include "uav_agent/standoff.hpp"
#include "uav_agent/strips.hpp"
#include "uav_agent/survey.hpp"

namespace skein::agent {
namespace {

constexpr double kLookAheadDtS = 0.25;      ///< of the predictions for safety and traffic
constexpr int kLookAheadCount = 13;
constexpr double kStopSlackM = 0.4;         ///< the safety stop is this much less careful than planning
constexpr double kRefitS = 2.0;             ///< between two looks at the map while on a strip
constexpr double kRetryS = 1.0;             ///< after nothing could be done
constexpr double kRestS = 3.0;              ///< after a round in which no strip could be flown
constexpr double kLookAroundTurn = 0.8;     ///< meanwhile [rad]
constexpr double kLayerM = 2.0;             ///< between the heights to which two UAVs climb
constexpr double kLinkPatienceS = 4.0;      ///< at a delivery place without a link
constexpr double kNoBoxesHeightM = 3.0;
constexpr double kViewTurns[] = {0.0, 0.45, -0.45};  ///< of the camera to the side, by round [rad]
constexpr int kMaxFailures = 3;
constexpr double kMinClearanceM = 1.8;      ///< of the UAV's centre: the map's cells are coarse, however small the UAV is
constexpr int kMaxClimbs = 20;
/// Rays that must have passed unknown places, less and less of them for a UAV that cannot get anywhere; in the end it takes
/// the low space outside all boxes to be free.
constexpr int kRays[] = {8, 4, 2, 2};
constexpr double kTrailStepM = 1.0, kRetreatM = 10.0;
constexpr std::size_t kTrailCount = 100;
constexpr double kDetourAgainS = 20.0;
constexpr double kWatchM = 0.5, kWatchS = 12.0;  ///< no further than this for so long: something is wrong

}  // namespace

class PatrolPlanner final : public Planner {
 public:
  struct Config {
    bool use_map = true;               ///< false: knows nothing but the boxes; for comparison
    bool survey = true;                ///< explorers fly once around everything first
    bool top = true, bottom = true;    ///< look at these faces, too
    double clearance_m = 1.2;          ///< from the UAV's body to anything mapped
    double transit_mps = 4.5, survey_mps = 4.0, climb_mps = 2.5;
    double survey_standoff_m = 10.0;
    double standoff_ratio = 0.92;      ///< distance to the surface in units of d*
    double blind_ratio = 0.55;         ///< distance to a box's face where no surface is mapped
    double overlap = 0.2;
    double speed_gain = 1.0;           ///< 1: no blur
    double blind_height_ratio = 0.45;  ///< of the highest box: below it, only space that was seen free is entered
    double deliver_every_s = 240.0;
    double return_margin_s = 12.0;

    template <class R>
    void describe(R& r) {
      r.field("use_map", use_map);
      r.field("survey", survey);
      r.field("top", top);
      r.field("bottom", bottom);
      r.field("clearance_m", clearance_m, within(0.3, 10.0));
      r.field("transit_mps", transit_mps, within(0.5, 20.0));
      r.field("survey_mps", survey_mps, within(0.5, 20.0));
      r.field("climb_mps", climb_mps, within(0.2, 10.0));
      r.field("survey_standoff_m", survey_standoff_m, within(2.0, 50.0));
      r.field("standoff_ratio", standoff_ratio, within(0.3, 1.5));
      r.field("blind_ratio", blind_ratio, within(0.2, 1.5));
      r.field("overlap", overlap, within(0.0, 0.8));
      r.field("speed_gain", speed_gain, within(0.2, 5.0));
      r.field("blind_height_ratio", blind_height_ratio, within(0.0, 1.0));
      r.field("deliver_every_s", deliver_every_s, within(10.0, 1e6));
      r.field("return_margin_s", return_margin_s, within(0.0, 600.0));
    }
  };

  PatrolPlanner(const Config& config, const AgentConfig& agent)
      : config_(config),
        agent_(agent),
        reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)),
        separation_(Separation::Config(), agent_) {}

  PlannerOutput plan(const PlannerInput& in) override {
    PlannerOutput out;
    if (!in.boxes.empty() && !shared_) share_work(in);
    if (phase_ == Phase::ground) {
      if (separation_.may_lift_off(in.tick, in.peers)) lift_off(in, out);
      return out;
    }
    const FreeSpace space = free_space(in);
    leave_trail(in);
    if (in.undelivered_captures == 0) delivered_at_ = in.tick;
    if (phase_ != Phase::deliver && must_deliver(in)) {
      begin_delivery(in, space, out);
    } else if (!gives_way(in, out) && !stops_for_obstacle(in, space, out)) {
      if (stands_still(in)) {
        give_up(in, out);
      } else {
        carry_on(in, space, out);
      }
    }
    return out;
  }

 private:
  enum class Phase { ground, climb, survey, transit, strip, deliver, idle };

  FreeSpace::Config space_config() const;
  FreeSpace free_space(const PlannerInput& in) const;
  FreeSpace way_space(const PlannerInput& in, const Vector3d& goal) const;
  void share_work(const PlannerInput& in);
  void lift_off(const PlannerInput& in, PlannerOutput& out);
  bool gives_way(const PlannerInput& in, PlannerOutput& out);
  bool goes_around(const std::vector<Waypoint>& rest, const PlannerInput& in, PlannerOutput& out);
  bool stops_for_obstacle(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  bool stands_still(const PlannerInput& in);
  void leave_trail(const PlannerInput& in);
  bool retreat(PlannerOutput& out);
  void give_up(const PlannerInput& in, PlannerOutput& out);
  void carry_on(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void finish_climb(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void begin_survey(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void next_strip(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void approach(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void fly_strip(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void refit(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void face_strip(PlannerOutput& out) const;
  bool must_deliver(const PlannerInput& in) const;
  void begin_delivery(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void deliver(const PlannerInput& in, PlannerOutput& out);
  bool fly_to(const Vector3d& goal, const PlannerInput& in, PlannerOutput& out);
  void follow(Path path, PlannerOutput& out);
  void idle(Tick until, PlannerOutput& out);
  std::vector<Waypoint> rest_of_path(const PlannerInput& in) const;
  Vector3d home() const;
  StandoffConfig standoff_config() const;

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;
  Separation separation_;

  Phase phase_ = Phase::ground;
  Path path_;                          ///< being flown, or to be taken up again after a pause
  bool paused_ = false;
  double top_m_ = 0.0, blind_height_m_ = 0.0;

  bool shared_ = false;
  std::vector<Strip> strips_;
  std::vector<Visit> tour_;            ///< own share
  std::deque<std::size_t> to_do_;      ///< of this round: indices into tour_
  int round_ = -1;
  bool flown_any_ = true;              ///< in this round
  std::size_t boldness_ = 0;           ///< index into kRays
  std::size_t current_ = 0;            ///< index into tour_
  double strip_s_ = 0.0;               ///< where on the strip the present run begins
  Tick refit_at_ = 0, idle_until_ = 0;
  int failures_ = 0;
  Vector3d climb_to_ = Vector3d::Zero();
  std::deque<Vector3d> trail_;         ///< where it was, a metre apart
  std::optional<Tick> detour_at_;      ///< when it last went around somebody
  Vector3d watched_p_W_ = Vector3d::Zero();
  Tick watched_since_ = 0;

  std::vector<Vector3d> places_;       ///< for delivery
  std::size_t place_ = 0;
  bool heading_home_ = false;
  Tick delivered_at_ = 0;
  std::optional<Tick> unlinked_since_;
};

FreeSpace::Config PatrolPlanner::space_config() const {
  FreeSpace::Config config;
  config.clearance_m = std::max(kMinClearanceM, agent_.me().body_radius_m + config_.clearance_m);
  config.use_map = config_.use_map;
  config.rays = kRays[boldness_];
  config.blind_height_m = boldness_ + 1 < std::size(kRays) ? blind_height_m_ : 0.0;
  return config;
}

/// Where strips may be flown.
FreeSpace PatrolPlanner::free_space(const PlannerInput& in) const { return {space_config(), in.boxes, in.map}; }

/// Where the way to a goal may lead.
FreeSpace PatrolPlanner::way_space(const PlannerInput& in, const Vector3d& goal) const {
  FreeSpace::Config config = space_config();
  const Vector3d here = in.tracking.setpoint.p_WB;
  config.enter_near_W = {here, goal};
  return {config, in.boxes, in.map, separation_.keep_out(here, in.peers)};
}

StandoffConfig PatrolPlanner::standoff_config() const {
  StandoffConfig config;
  config.ratio = config_.standoff_ratio;
  config.blind_ratio = config_.blind_ratio;
  config.speed_gain = config_.speed_gain;
  config.max_speed_mps = config_.transit_mps;
  return config;
}

/// Everybody's share, of which this UAV keeps its own. Strips that run inside another box are nobody's.
void PatrolPlanner::share_work(const PlannerInput& in) {
  shared_ = true;
  for (const OrientedBox& box : in.boxes) {
    const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
    top_m_ = std::max(top_m_, box.center.z() + half.z());
  }
  const bool lidar_in_fleet = std::any_of(agent_.fleet.begin(), agent_.fleet.end(), [](const FleetMember& member) {
    return member.role == Role::explorer;
  });
  if (lidar_in_fleet && config_.use_map) blind_height_m_ = config_.blind_height_ratio * top_m_;

  StripConfig strip_config;
  strip_config.standoff_ratio = config_.standoff_ratio;
  strip_config.overlap = config_.overlap;
  strip_config.top = config_.top;
  strip_config.bottom = config_.bottom;
  FreeSpace::Config by_boxes;
  by_boxes.use_map = false;
  const OccupancyMap nothing;
  const FreeSpace space(by_boxes, in.boxes, nothing);
  std::vector<double> work_s;
  for (const Strip& strip : cut_into_strips(in.boxes, reach_, strip_config)) {
    double seconds = 0.0;
    for (const Run& run : fit_strip(strip, false, 0.0, {}, space, reach_, standoff_config())) {
      seconds += static_cast<double>(run.waypoints.size() - 1) * standoff_config().step_m /
                 (config_.standoff_ratio * reach_.blur_speed_mps * config_.speed_gain);
    }
    if (seconds <= 0.0) continue;
    strips_.push_back(strip);
    work_s.push_back(seconds);
  }

  std::vector<Vector3d> starts;
  std::vector<double> free_at_s;
  for (std::size_t i = 0; i < agent_.fleet.size(); ++i) {
    AgentConfig other = agent_;
    other.self = i;
    const auto ring = survey_ring(other, in.boxes, config_.survey_standoff_m, 0.0);
    const bool surveys = config_.survey && config_.use_map && !ring.empty();
    const Vector3d start = surveys ? ring.back() : agent_.fleet[i].p_WB_start;
    starts.emplace_back(start.x(), start.y(), 0.5 * top_m_);
    free_at_s.push_back(surveys ? path_length(ring.front(), ring) / config_.survey_mps : 0.0);
  }
  tour_ = share_strips(strips_, work_s, starts, free_at_s, config_.transit_mps)[agent_.self];
}

void PatrolPlanner::lift_off(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d p = in.state.p_WB;
  const auto others = static_cast<double>(agent_.fleet.size() - 1 - agent_.self);
  double height = kNoBoxesHeightM + kLayerM * others;
  if (shared_) height = std::max(height, blind_height_m_ + 1.0 + kLayerM * others);
  for (const OrientedBox& box : in.boxes) {  // no higher than below whatever hangs over the start
    const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
    const double bottom = box.center.z() - half.z();
    const double below = bottom - agent_.me().body_radius_m - config_.clearance_m;
    const bool under = box.contains(Vector3d(p.x(), p.y(), box.center.z()), 1.0) && bottom > p.z();
    if (under) height = std::min(height, std::max(below, p.z() + kNoBoxesHeightM));
  }
  phase_ = Phase::climb;
  delivered_at_ = in.tick;
  climb_to_ = Vector3d(p.x(), p.y(), std::max(height, p.z()));
  follow(Path{{{climb_to_, config_.climb_mps}}}, out);
  out.gimbal = GimbalCommand{GimbalMode::angle, 0.0, 0.0};
}

std::vector<Waypoint> PatrolPlanner::rest_of_path(const PlannerInput& in) const {
  if (paused_) return path_.waypoints;
  const std::size_t leg = std::min(in.tracking.leg, path_.waypoints.size());
  return {path_.waypoints.begin() + static_cast<std::ptrdiff_t>(leg), path_.waypoints.end()};
}

bool PatrolPlanner::gives_way(const PlannerInput& in, PlannerOutput& out) {
  const std::vector<Waypoint> rest = rest_of_path(in);
  if (rest.empty()) return false;
  const auto ahead = positions_ahead(in.tracking.setpoint.p_WB, rest, kLookAheadDtS, kLookAheadCount);
  switch (separation_.judge(in.tick, ahead, kLookAheadDtS, in.peers)) {
    case Traffic::clear:
      if (paused_) {
        paused_ = false;
        out.motion = path_;
        return true;
      }
      return false;
    case Traffic::wait:
      if (!paused_) {
        path_.waypoints = rest;
        paused_ = true;
        out.motion = Hold{};
      }
      return true;
    case Traffic::go_around: {
      // One detour is worth a try. If it led to nothing, the other UAV has work here: something else first.
      const bool again = detour_at_ && seconds(in.tick - *detour_at_) < kDetourAgainS;
      detour_at_ = in.tick;
      if (phase_ == Phase::climb || again || !goes_around(rest, in, out)) give_up(in, out);
      return true;
    }
  }
  return false;
}

/// Leaves the path for a way around whoever stands on it, and comes back to it behind them.
bool PatrolPlanner::goes_around(const std::vector<Waypoint>& rest, const PlannerInput& in, PlannerOutput& out) {
  const FreeSpace space = way_space(in, rest.back().p_WB);
  std::size_t back = 0;
  while (back + 1 < rest.size() && !space.free(rest[back].p_WB)) ++back;
  const auto way = find_path(space, in.boxes, in.tracking.setpoint.p_WB, rest[back].p_WB);
  if (!way) return false;
  Path around;
  for (const Vector3d& p : *way) around.waypoints.push_back({p, config_.transit_mps});
  around.waypoints.insert(around.waypoints.end(), rest.begin() + static_cast<std::ptrdiff_t>(back) + 1, rest.end());
  // The rest of a strip is fitted anew where the detour ends: its waypoints are no longer numbered as they were.
  if (phase_ == Phase::strip) phase_ = Phase::transit;
  follow(std::move(around), out);
  return true;
}

/// What this UAV was about must wait for another time.
void PatrolPlanner::give_up(const PlannerInput& in, PlannerOutput& out) {
  if (phase_ == Phase::deliver) {
    place_ = (place_ + 1) % (places_.size() + 1);
    path_.waypoints.clear();
    paused_ = false;
    out.motion = Hold{};
    return;
  }
  if (phase_ == Phase::climb) {
    path_.waypoints.clear();
    paused_ = false;
    out.motion = Hold{};
    idle_until_ = in.tick + ticks(kRetryS);
    return;
  }
  if (phase_ == Phase::transit || phase_ == Phase::strip) to_do_.push_back(current_);
  idle(in.tick, out);
}

/// Has a path and does not get on with it, for whatever reason.
bool PatrolPlanner::stands_still(const PlannerInput& in) {
  const bool moved = (in.state.p_WB - watched_p_W_).norm() > kWatchM;
  if (moved || path_.waypoints.empty() || in.tracking.done) {
    watched_p_W_ = in.state.p_WB;
    watched_since_ = in.tick;
  }
  if (seconds(in.tick - watched_since_) < kWatchS) return false;
  watched_since_ = in.tick;
  return true;
}

bool PatrolPlanner::stops_for_obstacle(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  if (!config_.use_map || in.k % 4 != 0) return false;
  const std::vector<Waypoint> rest = rest_of_path(in);
  if (rest.empty()) return false;
  const Vector3d here = in.tracking.setpoint.p_WB;
  // Whoever is too near to something already may still move away from it.
  double limit = space.config().clearance_m - kStopSlackM;
  if (const auto now = in.map.distance_to_occupied(here, limit)) limit = std::max(0.0, *now - 0.1);
  const auto ahead = positions_ahead(here, rest, kLookAheadDtS, kLookAheadCount);
  const bool clear = std::all_of(ahead.begin() + 1, ahead.end(), [&](const Vector3d& p) {
    return !in.map.any_occupied_within(p, limit);
  });
  if (clear) return false;
  out.motion = Hold{};
  path_.waypoints.clear();
  if (phase_ == Phase::deliver || phase_ == Phase::climb) {
    idle_until_ = in.tick + ticks(kRetryS);
  } else if (phase_ == Phase::strip) {
    strip_s_ += standoff_config().step_m * static_cast<double>(in.tracking.leg);
    phase_ = Phase::transit;  // from here: fits the rest of the strip anew
  } else {
    if (phase_ == Phase::transit && ++failures_ <= kMaxFailures) to_do_.push_front(current_);
    idle(in.tick, out);
  }
  return true;
}

/// Remembers where it was: what was free once is free now.
void PatrolPlanner::leave_trail(const PlannerInput& in) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  if (!trail_.empty() && (trail_.back() - here).norm() < kTrailStepM) return;
  trail_.push_back(here);
  if (trail_.size() > kTrailCount) trail_.pop_front();
}

/// Some metres back the way it came, out of a corner where no path begins.
bool PatrolPlanner::retreat(PlannerOutput& out) {
  Path path;
  double length = 0.0;
  while (trail_.size() > 1 && length < kRetreatM) {
    const Vector3d from = trail_.back();
    trail_.pop_back();
    length += (trail_.back() - from).norm();
    path.waypoints.push_back({trail_.back(), config_.survey_mps});
  }
  if (path.waypoints.empty()) return false;
  follow(std::move(path), out);
  return true;
}

void PatrolPlanner::follow(Path path, PlannerOutput& out) {
  path_ = std::move(path);
  paused_ = false;
  out.motion = path_;
}

void PatrolPlanner::idle(Tick until, PlannerOutput& out) {
  phase_ = Phase::idle;
  idle_until_ = until;
  path_.waypoints.clear();
  paused_ = false;
  if (std::holds_alternative<std::monostate>(out.motion)) out.motion = Hold{};
}

bool PatrolPlanner::fly_to(const Vector3d& goal, const PlannerInput& in, PlannerOutput& out) {
  const auto corners = find_path(way_space(in, goal), in.boxes, in.tracking.setpoint.p_WB, goal);
  if (!corners) return false;
  Path path;
  for (const Vector3d& p : *corners) path.waypoints.push_back({p, config_.transit_mps});
  follow(std::move(path), out);
  return true;
}

void PatrolPlanner::carry_on(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  switch (phase_) {
    case Phase::climb:
      if (in.tracking.done) finish_climb(in, space, out);
      return;
    case Phase::survey:
      if (in.tracking.done) idle(in.tick, out);
      return;
    case Phase::transit:
      if (in.tracking.done) fly_strip(in, space, out);
      return;
    case Phase::strip:
      if (in.tracking.done) {
        strip_s_ += standoff_config().step_m * static_cast<double>(path_.waypoints.size());
        approach(in, space, out);
      } else if (in.tick >= refit_at_) {
        refit(in, space, out);
      }
      return;
    case Phase::deliver:
      deliver(in, out);
      return;
    case Phase::idle:
      if (in.tick >= idle_until_ && in.tracking.done) next_strip(in, space, out);
      return;
    case Phase::ground:
      return;
  }
}

/// At the top: on to work. Stopped on the way: tries again for a while.
void PatrolPlanner::finish_climb(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  const bool short_of_top = (climb_to_ - in.tracking.setpoint.p_WB).norm() > 0.5;
  if (short_of_top && failures_ < kMaxClimbs) {
    if (in.tick < idle_until_) return;
    ++failures_;
    follow(Path{{{climb_to_, config_.climb_mps}}}, out);
  } else if (shared_) {  // else it stays where it is until it knows the boxes
    failures_ = 0;
    trail_.clear();  // it leads down to the ground
    begin_survey(in, space, out);
  }
}

void PatrolPlanner::begin_survey(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  idle(in.tick, out);
  if (!config_.survey || !config_.use_map) return;
  const double height = std::max(blind_height_m_ + 2.0, 0.5 * top_m_);
  Path path;
  Vector3d at = in.tracking.setpoint.p_WB;
  for (const Vector3d& corner : survey_ring(agent_, in.boxes, config_.survey_standoff_m, height)) {
    const auto way = find_path(space, in.boxes, at, corner);
    if (!way) continue;
    for (const Vector3d& p : *way) path.waypoints.push_back({p, config_.survey_mps});
    at = corner;
  }
  if (path.waypoints.empty()) return;
  phase_ = Phase::survey;
  follow(std::move(path), out);
}

void PatrolPlanner::next_strip(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  if (to_do_.empty()) {
    if (!flown_any_ || tour_.empty()) {
      flown_any_ = true;
      boldness_ = std::min(boldness_ + 1, std::size(kRays) - 1);
      idle(in.tick + ticks(kRestS), out);
      if (!tour_.empty()) retreat(out);
      // A LiDAR that has turned makes a new key frame.
      out.yaw = wrap_angle(in.tracking.setpoint.yaw + kLookAroundTurn);
      return;
    }
    // The next round begins where the last one ended.
    ++round_;
    flown_any_ = false;
    failures_ = 0;
    if (round_ > 0) {
      std::reverse(tour_.begin(), tour_.end());
      for (Visit& visit : tour_) visit.reversed = !visit.reversed;
    }
    for (std::size_t i = 0; i < tour_.size(); ++i) to_do_.push_back(i);
  }
  current_ = to_do_.front();
  to_do_.pop_front();
  strip_s_ = 0.0;
  approach(in, space, out);
}

/// Flies to the beginning of what can be flown of the current strip from strip_s_ on, or gives it up for this round.
void PatrolPlanner::approach(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  const Visit& visit = tour_[current_];
  const Strip& strip = strips_[visit.strip];
  if (strip_s_ < strip.length()) {
    for (const Run& run : fit_strip(strip, visit.reversed, strip_s_, {}, space, reach_, standoff_config())) {
      if (!fly_to(run.waypoints.front().p_WB, in, out)) continue;
      strip_s_ = run.first_s;
      phase_ = Phase::transit;
      face_strip(out);
      return;
    }
  }
  failures_ = 0;
  idle(in.tick, out);
}

void PatrolPlanner::fly_strip(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  const Visit& visit = tour_[current_];
  const auto runs = fit_strip(strips_[visit.strip], visit.reversed, strip_s_, in.tracking.setpoint.p_WB, space, reach_,
                              standoff_config());
  if (runs.empty()) {
    idle(in.tick, out);
    return;
  }
  if (runs.front().first_s > strip_s_) {  // the map has closed the beginning
    strip_s_ = runs.front().first_s;
    if (++failures_ > kMaxFailures) {
      idle(in.tick, out);
    } else {
      approach(in, space, out);
    }
    return;
  }
  flown_any_ = true;
  boldness_ = 0;
  phase_ = Phase::strip;
  refit_at_ = in.tick + ticks(kRefitS);
  follow(Path{runs.front().waypoints}, out);
  face_strip(out);
}

/// The map may have grown: fits what is left of the strip again.
void PatrolPlanner::refit(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  refit_at_ = in.tick + ticks(kRefitS);
  const Visit& visit = tour_[current_];
  const Strip& strip = strips_[visit.strip];
  const double s = strip_s_ + standoff_config().step_m * static_cast<double>(in.tracking.leg);
  if (s >= strip.length()) return;
  const auto runs = fit_strip(strip, visit.reversed, s, in.tracking.setpoint.p_WB, space, reach_, standoff_config());
  if (runs.empty() || runs.front().first_s > s) return;  // the safety stop will see to it
  strip_s_ = s;
  follow(Path{runs.front().waypoints}, out);
}

void PatrolPlanner::face_strip(PlannerOutput& out) const {
  const Strip& strip = strips_[tour_[current_].strip];
  const double pitch_limit = agent_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg;
  if (strip.kind == FaceKind::side) {
    out.yaw = std::atan2(-strip.out_W.y(), -strip.out_W.x());
    const double turn = kViewTurns[std::max(0, round_) % std::size(kViewTurns)];
    out.gimbal = GimbalCommand{GimbalMode::angle, 0.0, turn};
    return;
  }
  // Along the strip and always the same way, so that the image's full width lies across it and nothing turns in between.
  const Vector3d along = strip.end_W - strip.begin_W;
  out.yaw = std::atan2(along.y(), along.x());
  out.gimbal = GimbalCommand{GimbalMode::angle, strip.kind == FaceKind::top ? pitch_limit : -pitch_limit, 0.0};
}

Vector3d PatrolPlanner::home() const {
  if (place_ < places_.size()) return places_[place_];
  const double height = top_m_ + 6.0 + kLayerM * static_cast<double>(agent_.self);
  return {agent_.station_position.x(), agent_.station_position.y(), height};
}

bool PatrolPlanner::must_deliver(const PlannerInput& in) const {
  if (!shared_ || !in.mission_remaining_s || phase_ == Phase::climb) return false;
  const double way_s = time_home_s(in.state.p_WB, home(), config_.transit_mps);
  if (*in.mission_remaining_s < way_s + config_.return_margin_s) return true;
  return in.undelivered_captures > 0 && seconds(in.tick - delivered_at_) > config_.deliver_every_s;
}

void PatrolPlanner::begin_delivery(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  const double lowest = std::max(blind_height_m_ + 2.0, 6.0);
  places_ = delivery_places(agent_, space, lowest);
  place_ = 0;
  phase_ = Phase::deliver;
  unlinked_since_.reset();
  out.motion = Hold{};
  path_.waypoints.clear();
  paused_ = false;
  idle_until_ = in.tick;
  deliver(in, out);
}

void PatrolPlanner::deliver(const PlannerInput& in, PlannerOutput& out) {
  const bool all_delivered = in.station_linked && in.undelivered_captures == 0;
  const double way_s = time_home_s(in.state.p_WB, home(), config_.transit_mps);
  const bool last_time = in.mission_remaining_s && *in.mission_remaining_s < 2.0 * (way_s + config_.return_margin_s);
  if (all_delivered && !last_time) {
    idle(in.tick, out);  // back to work; the strip that was left is in a later round's share
    return;
  }
  if (all_delivered || (in.station_linked && in.tracking.done)) {
    unlinked_since_.reset();
    return;
  }
  if (!path_.waypoints.empty() && in.tracking.done && !heading_home_) path_.waypoints.clear();  // after a retreat
  if (!path_.waypoints.empty() && in.tracking.done) {
    if (!unlinked_since_) unlinked_since_ = in.tick;
    if (seconds(in.tick - *unlinked_since_) < kLinkPatienceS) return;
    unlinked_since_.reset();
    place_ = (place_ + 1) % (places_.size() + 1);
    path_.waypoints.clear();
  }
  if (path_.waypoints.empty() && in.tick >= idle_until_) {
    idle_until_ = in.tick + ticks(kRetryS);
    heading_home_ = fly_to(home(), in, out);
    if (heading_home_) return;
    place_ = (place_ + 1) % (places_.size() + 1);
    if (++failures_ % kMaxFailures == 0) retreat(out);
  }
}

SKEIN_REGISTER_PLANNER("patrol", PatrolPlanner);

}  // namespace skein::agent
