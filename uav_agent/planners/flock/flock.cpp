// flock: all UAVs follow the same rule: each one does what raises the fleet's score most for the time that it takes.
//
// 1. Work is quality that can still be gained (surfaces.hpp): by interest points expected on surface that no camera
//    has looked at, and by known points whose best picture is not perfect. A detection tells where a point is and how
//    good its picture was. UAVs that hear each other share points and the surface that was looked at.
// 2. The targets propose views (views.hpp), and the formulas of the score judge them.
// 3. Each UAV takes the views that gain most per second (route.hpp), without what others have announced (talk.hpp).
//    There are no teams and no fixed shares: when a UAV is lost, its claims expire, and others take its work.
//    A UAV whose camera has failed (camera.hpp) takes and announces no views until the camera works again.
// 4. Explorers do the same work. In addition, they fly through space that is not proved free yet, which opens it to the
//    photographers, and to where no LiDAR has looked for structure (survey.hpp).
// The flight core does the flying (flight_core/flight_core.hpp); docs/flock.md tells how well it works.
#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/voxel_route.hpp"
#include "uav_agent/planners/flock/camera.hpp"
#include "uav_agent/planners/flock/cargo.hpp"
#include "uav_agent/planners/flock/config.hpp"
#include "uav_agent/planners/flock/reach.hpp"
#include "uav_agent/planners/flock/route.hpp"
#include "uav_agent/planners/flock/stay.hpp"
#include "uav_agent/planners/flock/surfaces.hpp"
#include "uav_agent/planners/flock/talk.hpp"
#include "uav_agent/planners/flock/trail.hpp"
#include "uav_agent/planners/flock/views.hpp"
#include "uav_agent/planners/flock/work.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {
namespace {

constexpr std::uint64_t kCameraSteps = 3;  ///< exchanges between two updates from the camera's view; chosen
constexpr double kRestS = 0.5;             ///< time between two decisions while there is nothing to photograph; chosen
constexpr std::size_t kMostLegs = 3;       ///< most views in a goal for the flight core; chosen
constexpr int kTries = 4;            ///< most routes tried in a decision, if there is no way to the first view; chosen
constexpr double kAimAheadS = 0.9;   ///< the camera turns to a view this long before the UAV gets there; chosen
constexpr double kSeekAfterS = 4.0;  ///< after resting for this long (chosen), the flight core searches paths to ...
constexpr std::size_t kMostSought = 4;  ///< ... this many views (chosen), ...
constexpr double kSeekS = 12.0;         ///< ... and after this time to others; chosen

}  // namespace

class FlockPlanner final : public Planner {
 public:
  using Config = FlockConfig;

  FlockPlanner(const Config& config, const AgentConfig& agent)
      : config_(config),
        agent_(agent),
        sharp_m_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel).sharp_distance_m),
        views_(config_, agent_, sharp_m_),
        camera_(agent.vehicle.camera.trigger_interval_s),
        talk_({.share_s = config.share_s, .claim_s = config.claim_s}, agent_),
        reach_(agent_, talk_) {}

  const FlightConfig* flight() const override { return &config_.flight; }
  PlannerOutput plan(const PlannerInput& in) override;

 private:
  void set_up(const PlannerInput& in);
  bool has_lidar() const { return agent_.me().role == Role::explorer; }
  void look_around(const PlannerInput& in);
  void change_work();
  void handle_outcome(const Outcome& outcome, const PlannerInput& in);
  void carry_on(const PlannerInput& in, PlannerOutput& out);
  void note_picture(const FlockView::Sight& sight);
  void glance(const PlannerInput& in, PlannerOutput& out);
  std::vector<FlockView> find_views(const PlannerInput& in);
  void decide(const PlannerInput& in, PlannerOutput& out);
  std::optional<std::vector<Vector3d>> way_W(const PlannerInput& in, const Vector3d& to_W) const;
  void offer(const PlannerInput& in, const std::optional<std::vector<Vector3d>>& way, PlannerOutput& out);
  void rest(const PlannerInput& in, std::vector<Vector3d> sought_W, PlannerOutput& out);
  FlockWord own_word() const;

  const Config config_;
  const AgentConfig agent_;
  const double sharp_m_;
  FlockViews views_;
  FlockCamera camera_;
  FlockTalk talk_;
  FlockReach reach_;
  std::optional<FlockSurfaces> surfaces_;  ///< set when the boxes have arrived
  std::optional<FlockTargets> targets_;    ///< as of the last decision

  std::vector<FlockView> route_;  ///< the UAV flies to the first view
  std::int64_t id_ = 0;           ///< id of the route's goal
  bool rests_ = false;
  FlockStay stay_;
  Tick planned_at_ = 0, glance_until_ = 0, sought_at_ = 0;
  FlockWork work_;
  FlockCargo cargo_;
  bool glances_ = false;  ///< the camera looks elsewhere than the route's first view
  FlockTrail trail_;
  Vector3d rest_W_ = Vector3d::Zero();
  std::optional<FlockView> lookout_;  ///< where it waits for its camera to work again
};

PlannerOutput FlockPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty()) set_up(in);
  if (!surfaces_) return out;
  talk_.listen(in, surfaces_->grid(), surfaces_->points());
  look_around(in);
  for (const Outcome& outcome : in.flight.outcomes) handle_outcome(outcome, in);
  if (in.flight.working) {
    carry_on(in, out);
  } else {
    route_.clear();
  }
  out.stake = cargo_.stake();
  talk_.speak(in, surfaces_->told_grid(), surfaces_->points(), own_word(), out);
  return out;
}

/// Begins anew when the UAV begins to fly without a map, before it knows any surface, and when it has a map again.
void FlockPlanner::set_up(const PlannerInput& in) {
  const bool unknown = !surfaces_ || surfaces_->blind() || surfaces_->surface_m2() == 0.0;
  const bool blind = unknown && in.space && in.space->config().blind_fleet;
  if (surfaces_ && surfaces_->blind() == blind) return;
  std::optional<FlockSurfaces> before = std::move(surfaces_);
  surfaces_.emplace(config_, agent_, in.boxes, sharp_m_, blind);
  if (before) surfaces_->points() = std::move(before->points());
  if (before) surfaces_->survey() = std::move(before->survey());
  targets_.reset();
  route_.clear();
}

void FlockPlanner::look_around(const PlannerInput& in) {
  const PartTimer timer(in.parts, "planner/map and pictures");
  const CameraState camera = camera_state(in.state, in.gimbal, agent_.vehicle.camera);
  cargo_.update(surfaces_->detect(in.detected, camera.X_WC.translation()), in.undelivered_captures);
  const bool failed = camera_.failed();
  camera_.hear(!in.detected.empty(), in.tick);
  if (in.k % kCameraSteps == 0 && in.tracking.airborne) {
    const Exposure exposure(camera, agent_.vehicle.camera, agent_.desired_mm_per_pixel, ResolutionRule::contest);
    if (camera_.in_doubt(in.tick)) {
      camera_.expect(surfaces_->clear_points(exposure, in.tick), exposure.position(), in.tick);
    }
    if (!camera_.failed()) surfaces_->look_at_picture(exposure, in.tick);
  }
  if (camera_.failed() != failed) change_work();
  if (!agent_.due(in.k, WorldVoxels::kUpdateS, agent_.self)) return;
  surfaces_->look_at_map(*in.world_map);
  if (has_lidar()) surfaces_->survey().look(surfaces_->grid(), in.state.p_WB);
  for (const Peer& peer : in.peers.all()) {
    if (!peer.visible || agent_.fleet[peer.uav].role != Role::explorer) continue;
    surfaces_->survey().look(surfaces_->grid(), peer.p_W);
    trail_.note(peer.p_W);
  }
}

/// Call it when the camera has failed or works again: drops the plans, which assumed the opposite.
void FlockPlanner::change_work() {
  if (camera_.failed()) surfaces_->forget_pictures();
  route_.clear();
  lookout_.reset();
  rests_ = glances_ = false;
}

void FlockPlanner::handle_outcome(const Outcome& outcome, const PlannerInput& in) {
  if (lookout_ && outcome.kind != Outcome::Kind::reached) {
    reach_.refuse(lookout_->p_WB, in.tick);
    lookout_.reset();
  }
  if (outcome.id != id_ || route_.empty() || outcome.kind == Outcome::Kind::reached) return;
  reach_.refuse(route_.front().p_WB, in.tick);
  route_.clear();
}

void FlockPlanner::carry_on(const PlannerInput& in, PlannerOutput& out) {
  if (rests_ && seconds(in.tick - planned_at_) < kRestS) return;
  const bool on_its_way = !route_.empty() && !stay_.arrived();
  if (reach_.stalls(in, on_its_way ? std::optional(route_.front().p_WB) : std::nullopt)) route_.clear();
  const bool due = seconds(in.tick - planned_at_) >= config_.replan_s;
  const bool taken = !route_.empty() && stay_.done(route_.front(), in, agent_.vehicle);
  if (taken) {
    for (const FlockView::Sight& sight : route_.front().sights) {
      note_picture(sight);
      if (!stay_.aimed()) surfaces_->leave_out(targets_->all()[sight.target], in.tick);
    }
    if (route_.front().survey > 0.0) surfaces_->survey().visited(in.state.p_WB, views_.surveyed_m());
    route_.erase(route_.begin());
    stay_.end();
  }
  if (due || route_.empty()) {
    decide(in, out);
  } else if (taken) {
    offer(in, way_W(in, route_.front().p_WB), out);
  } else {
    glance(in, out);
  }
}

void FlockPlanner::note_picture(const FlockView::Sight& sight) {
  FlockTarget& target = targets_->all()[sight.target];
  target.have = std::max(target.have, double{sight.q});
}

/// On the way to a view, turns the camera to other targets (glances), each time to those that gain most. While the
/// camera follows a place, its pictures are sharp however fast the UAV flies.
void FlockPlanner::glance(const PlannerInput& in, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/glances");
  if (config_.glance_s == 0.0 || in.tick < glance_until_ || !targets_) return;
  const FlockView& next = route_.front();
  const double way_m = (next.p_WB - in.state.p_WB).norm();
  const double speed = std::max(in.state.v_WB.norm(), 1.0);
  if (way_m / speed < kAimAheadS) {
    if (glances_) out.gimbal = next.aim_W;
    glances_ = false;
    return;
  }
  glance_until_ = in.tick + ticks(config_.glance_s);
  const Vector3d soon_W = in.state.p_WB + 0.5 * config_.glance_s * in.state.v_WB;
  const auto best = views_.glance(*surfaces_, *targets_, soon_W, in.state, in.gimbal);
  if (!best) return;
  for (const FlockView::Sight& sight : best->sights) note_picture(sight);
  glances_ = true;
  out.gimbal = best->aim_W;
}

/// Finds the targets, and views of them. Without a camera, there is no view to take; the targets are then all known
/// points, at which the UAV glances: one that it detects proves that the camera works again.
std::vector<FlockView> FlockPlanner::find_views(const PlannerInput& in) {
  const PartTimer timer(in.parts, "planner/views");
  if (camera_.failed()) {
    targets_.emplace(surfaces_->known_points(), views_.range_m());
    return {};
  }
  FlockTargets& targets = targets_.emplace(surfaces_->targets(in.tick), views_.range_m());
  for (const auto& [uav, claims] : talk_.claims(in.tick)) views_.count_claims(*surfaces_, claims, targets);
  return views_.find(*surfaces_, targets, *in.space, in.tracking.setpoint.p_WB, has_lidar());
}

void FlockPlanner::decide(const PlannerInput& in, PlannerOutput& out) {
  planned_at_ = in.tick;
  reach_.update(in.tick);
  std::vector<FlockView> views = find_views(in);
  FlockTargets& targets = *targets_;
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  std::vector<Vector3d> best_W = reach_.not_taken(views, kMostSought, in);
  const auto unreachable = [&](const FlockView& view) { return reach_.out_of_reach(view.p_WB, in); };
  std::erase_if(views, unreachable);
  std::optional<std::size_t> current;
  double survey = 0.0;  ///< FlockView::survey of the current view
  if (!route_.empty()) {
    FlockView view = route_.front();
    survey = std::exchange(view.survey, 0.0);
    if (!camera_.failed()) views_.judge(*surfaces_, targets, view);
    if (!unreachable(view)) {
      current = views.size();
      views.push_back(std::move(view));
    }
  }
  const CameraState camera = camera_state(in.state, in.gimbal, agent_.vehicle.camera);
  const FlockPace pace{.near_mps = config_.inspect_mps, .far_mps = config_.flight.approach_mps};
  const auto best_route = [&] {
    const PartTimer timer(in.parts, "planner/routes");
    return find_route(views, targets, surfaces_->grid(), here_W, camera.X_WC.linear().col(0), pace, config_.prove_gain,
                      config_.depth, current);
  };
  FlockRoute route = best_route();
  if (!camera_.failed()) work_.note(route.rate());
  if (has_lidar()) {
    const double left_s = in.mission_remaining_s.value_or(agent_.duration_s);
    const double lack = camera_.failed() ? 1.0 : work_.lack(talk_.rates(in.tick), targets, left_s, agent_.fleet.size());
    const std::size_t pictures = views.size();
    timed(in.parts, "planner/survey", [&] { views_.find_gaps(*surfaces_, *in.space, here_W, lack, views); });
    const auto gaps = views.begin() + static_cast<std::ptrdiff_t>(pictures);
    views.erase(std::remove_if(gaps, views.end(), unreachable), views.end());
    if (current) views[*current].survey = survey;
    if (views.size() > pictures || survey > 0.0) route = best_route();
  }
  std::optional<std::vector<Vector3d>> way;
  for (int tries = 1; !route.views.empty(); ++tries) {
    const Vector3d to_W = views[route.views.front()].p_WB;
    way = way_W(in, to_W);
    if (way || tries == kTries) break;
    reach_.refuse(to_W, in.tick);
    if (tries == 1) reach_.refuse_shut_off(views, surfaces_->grid(), in);
    for (FlockView& view : views) {
      if (!unreachable(view)) continue;
      view.sights.clear();
      view.survey = 0.0;
    }
    route = best_route();
  }
  cargo_.note(route.rate());
  if (route.views.empty()) return rest(in, std::move(best_W), out);
  route_.clear();
  for (const std::size_t i : route.views) route_.push_back(views[i]);
  if (!current || route.views.front() != *current) stay_.leave_place();
  rests_ = false;
  lookout_.reset();
  offer(in, way, out);
}

/// Corners of a free path from here to a place, the place included; nullopt if a search in the cubes finds none.
std::optional<std::vector<Vector3d>> FlockPlanner::way_W(const PlannerInput& in, const Vector3d& to_W) const {
  const PartTimer timer(in.parts, "planner/ways");
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  if (in.space->segment_free(here_W, to_W)) return std::vector<Vector3d>{to_W};
  return find_voxel_route(surfaces_->grid(), *in.space, here_W, to_W);
}

/// Offers the flight core a goal through the route's views, without a stop, as far as the way between them is free.
/// @param way  path to the first view; nullopt: the flight core searches one.
void FlockPlanner::offer(const PlannerInput& in, const std::optional<std::vector<Vector3d>>& way, PlannerOutput& out) {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  Goal goal;
  const double first_m = (route_.front().p_WB - here_W).norm();
  const double speed_mps = first_m > FlockPace::kFarM ? config_.flight.approach_mps : config_.inspect_mps;
  if (way) goal.way.push_back({here_W, config_.inspect_mps});
  for (const Vector3d& corner_W : way.value_or(std::vector{route_.front().p_WB})) {
    goal.way.push_back({corner_W, speed_mps});
  }
  for (std::size_t i = 1; i < std::min(route_.size(), kMostLegs); ++i) {
    const Vector3d& before_W = route_[i - 1].p_WB;
    const double leg_m = (route_[i].p_WB - before_W).norm();
    if (leg_m > FlockPace::kFarM || !in.space->segment_free(before_W, route_[i].p_WB)) break;
    goal.way.push_back({route_[i].p_WB, config_.inspect_mps});
  }
  const Vector3d look = route_.front().aim_W - route_.front().p_WB;
  if (!has_lidar() || route_.front().proved) goal.yaw = std::atan2(look.y(), look.x());
  goal.gimbal = route_.front().aim_W;
  const bool goes_on = in.flight.goal && *in.flight.goal == id_ && (way.has_value() == in.flight.on_way);
  if (!goes_on) ++id_;
  if (goes_on && way) goal.way.erase(goal.way.begin());
  goal.id = id_;
  if (goal.yaw && way) out.yaw = goal.yaw;
  if (!goes_on || !glances_) out.gimbal = route_.front().aim_W;
  out.goals = {std::move(goal)};
}

/// For a UAV without any view within its reach. A photographer follows an explorer. Otherwise, the flight core searches
/// paths to views that the UAV cannot reach through the cubes of its map, for example from below a canopy. If there are
/// none, an explorer with gaps left to survey leaves the flight core without a goal, so that its recovery behaviour
/// shows more of the site. Other UAVs hover at a goal, because with a goal the core begins no recovery behaviour. A UAV
/// whose camera has failed waits aside, at a place from which the camera would see known points.
/// @param sought_W  the best views that are out of reach.
void FlockPlanner::rest(const PlannerInput& in, std::vector<Vector3d> sought_W, PlannerOutput& out) {
  route_.clear();
  if (!rests_) sought_at_ = in.tick - ticks(kSeekS - kSeekAfterS);
  std::optional<Vector3d> aside_W = has_lidar() ? std::nullopt : trail_.behind_explorer_W(in);
  const bool explores = has_lidar() && !surfaces_->survey().gaps().empty();
  if (camera_.failed()) {
    if (!lookout_ && !explores) {
      const Vector3d here_W = in.tracking.setpoint.p_WB;
      lookout_ = reach_.first(views_.lookouts(*surfaces_, *targets_, *in.space, here_W), in);
    }
    if (lookout_) aside_W = lookout_->p_WB;
    const auto look = lookout_ ? lookout_ : views_.glance(*surfaces_, *targets_, in.state.p_WB, in.state, in.gimbal);
    if (look) out.gimbal = look->aim_W;
  }
  const bool may_seek = !aside_W && (!sought_W.empty() || explores);
  const bool seeks = may_seek && seconds(in.tick - sought_at_) >= kSeekS;
  if (rests_ && !seeks && (may_seek || in.flight.goal) && (!aside_W || FlockTrail::same(*aside_W, rest_W_))) return;
  rests_ = true;
  out.goals.emplace();
  if (seeks) {
    sought_at_ = in.tick;
  } else {
    rest_W_ = aside_W.value_or(in.tracking.setpoint.p_WB);
    sought_W = {rest_W_};
  }
  for (const Vector3d& p_W : sought_W) out.goals->push_back({.id = ++id_, .way = {{p_W, config_.flight.approach_mps}}});
  if (!lookout_) return;
  const Vector3d look = lookout_->aim_W - lookout_->p_WB;
  out.goals->front().yaw = std::atan2(look.y(), look.x());
}

FlockWord FlockPlanner::own_word() const {
  if (camera_.failed()) return {};  // a claim is a promise of pictures
  FlockWord word{.rate = work_.rate()};
  for (const FlockView& view : route_) {
    if (word.claims.size() < FlockTalk::kMostClaims) word.claims.push_back({view.p_WB, view.aim_W});
  }
  return word;
}

SKEIN_REGISTER_PLANNER("flock", FlockPlanner);

}  // namespace skein::agent
