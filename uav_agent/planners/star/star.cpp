// STAR: the strategy of the team that came third in the first contest, rebuilt from its published description.
//
// 1. Balanced teams consist of one explorer and its photographers; a multiple travelling salesmen problem over path
//    length and volume assigns the boxes to the teams (teams.hpp), once and for all. 2. Explorers explore their team's
//    boxes by frontiers: one viewpoint for each cluster, an ATSP over them (explorer.hpp). 3. UAVs send each other
//    their maps in chunks (talk.hpp). 4. Photographers begin at once: viewpoints before known surface that no UAV has
//    inspected (surfaces.hpp), in clusters, by a hierarchical ATSP (tour.hpp); without viewpoints they hover. Explorers
//    only explore, with the camera towards their frontiers. With `explorers_inspect`, or if the team has no
//    photographer, they also inspect: on the way the camera looks at surface that they pass and no UAV has inspected,
//    and when they have explored their boxes, they inspect like photographers. 5. All UAVs fly through their viewpoints
//    without a stop, turning and tilting the camera all the time, and plan again every 1.5 s; so pictures are blurred
//    and oblique.
//
// Its weaknesses are the published ones: boxes are assigned once, by path length; empty volume is explored like any
// other; photographers begin late; and pictures are taken in motion. Our additions: a team without work helps with the
// boxes of others (`helps`), and explorers may inspect (`explorers_inspect`, off by default). `faithful` switches our
// additions off, except those that are set by name: photographers without surface to inspect hover where they are for
// ever, even out of line of sight; an explorer that has explored its boxes is done, unless it inspects; a team without
// a box has nothing to do; UAVs plan without regard to where the others are about to work. The published collisions at
// the start are not reproduced.
// Not published for this contest, and so our choice: all numbers (config.hpp), the messages, and that the flight core
// does the flying (flight_core/flight_core.hpp).
#include <algorithm>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/star/camera.hpp"
#include "uav_agent/planners/star/knowledge.hpp"
#include "uav_agent/planners/star/talk.hpp"
#include "uav_agent/planners/star/teams.hpp"
#include "uav_agent/planners/star/tour.hpp"
#include "uav_agent/planners/star/way.hpp"

namespace skein::agent {
namespace {

constexpr std::uint64_t kCameraSteps = 4;  ///< exchanges between two updates from the camera's view; chosen
constexpr double kReachedM = 1.0;          ///< a place nearer than this counts as reached; chosen
constexpr std::size_t kCandidates = 3;     ///< routes offered in one plan, each with another first place; chosen
constexpr int kMaxApproaches = 4;          ///< approaches to a box in which no frontier was found; chosen
constexpr std::size_t kSidesApart = 3;     ///< sides between two approaches, of twelve sides; chosen
constexpr double kCarefulS = 10.0;  ///< after a blocked route, the flight core searches all paths for this time; chosen

}  // namespace

class StarPlanner final : public Planner {
 public:
  using Config = StarConfig;

  StarPlanner(const Config& config, const AgentConfig& agent)
      : config_(config.resolved()),
        agent_(agent),
        talk_({.share_s = config.share_s}, agent_),
        camera_(agent.vehicle, agent.me().role != Role::explorer) {}

  const FlightConfig* flight() const override { return &config_.flight; }
  PlannerOutput plan(const PlannerInput& in) override;

 private:
  /// A sequence of places offered to the flight core: of views, or of goals, or one place beside a box.
  struct Route {
    std::int64_t id = 0;
    std::vector<StarView> views = {};
    std::vector<StarGoal> goals = {};
    std::optional<Vector3d> beside_W = {};
    std::vector<Vector3d> places_W() const;
  };

  bool has_lidar() const { return agent_.me().role == Role::explorer; }
  bool inspects() const { return !has_lidar() || config_.explorers_inspect || team_.size() == 1; }
  StarTourConfig tour_config() const;

  void survey_site(const PlannerInput& in);
  void look_around(const PlannerInput& in);
  void handle_outcome(const Outcome& outcome, const PlannerInput& in);
  void carry_on(const PlannerInput& in, PlannerOutput& out);
  bool target_done(const PlannerInput& in);
  void put_off(const Route& route, const PlannerInput& in);
  void decide(const PlannerInput& in, PlannerOutput& out);
  void explore(const PlannerInput& in, PlannerOutput& out);
  bool inspect(const PlannerInput& in, PlannerOutput& out);
  void approach(const PlannerInput& in, std::size_t box, PlannerOutput& out);
  void idle(const PlannerInput& in, PlannerOutput& out);
  std::optional<std::size_t> awaited() const;
  bool team_is_done() const;
  void help_others(const PlannerInput& in);
  void begin_box(std::size_t box);
  void hover(const PlannerInput& in, PlannerOutput& out);
  void offer(std::vector<Route> routes, double speed_mps, const PlannerInput& in, PlannerOutput& out);
  Goal goal_of(Route& route, bool is_first, double speed_mps, const PlannerInput& in);
  void point_camera(const PlannerInput& in, PlannerOutput& out);
  StarTalk::Word own_word() const;

  const Config config_;
  const AgentConfig agent_;
  StarTalk talk_;
  StarCamera camera_;

  std::optional<StarKnowledge> known_;  ///< set when the boxes have arrived, like all that follows
  std::vector<std::size_t> team_;       ///< indices in the fleet, the explorer first
  std::vector<std::size_t> boxes_;      ///< of the team, in the order of visit

  std::size_t at_box_ = 0;   ///< index into boxes_; boxes_.size(): all are explored
  int approaches_ = 0;       ///< approaches to this box so far
  bool been_there_ = false;  ///< this box has or had frontiers, or its approaches are used up
  bool helps_others_ = false;
  std::vector<Route> routes_;  ///< offered to the flight core, which flies the first that it can reach
  std::int64_t id_ = 0;        ///< id of the last route that was offered
  std::optional<Vector3d> last_cluster_W_;
  Tick planned_at_ = 0, careful_until_ = 0;
  std::optional<Tick> idle_since_;
  std::size_t rounds_ = 0;  ///< how often the UAV looked elsewhere for work after a wait
};

std::vector<Vector3d> StarPlanner::Route::places_W() const {
  std::vector<Vector3d> places;
  for (const StarView& view : views) places.push_back(view.p_WB);
  for (const StarGoal& goal : goals) places.push_back(goal.p_WB);
  if (beside_W) places.push_back(*beside_W);
  return places;
}

PlannerOutput StarPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !known_) survey_site(in);
  if (!known_) return out;
  talk_.listen(in, known_->grid());
  look_around(in);
  for (const Outcome& outcome : in.flight.outcomes) handle_outcome(outcome, in);
  if (in.flight.working) {
    carry_on(in, out);
    if (idle_since_ && routes_.empty()) out.waits_for = awaited();
  } else {
    routes_.clear();
  }
  point_camera(in, out);
  talk_.speak(in, known_->grid(), own_word(), out);
  return out;
}

StarTourConfig StarPlanner::tour_config() const {
  return {.speed_mps = config_.inspect_mps,
          .turn_s = config_.turn_s,
          .radius_m = config_.view_radius_m,
          .history_s = config_.history_s,
          .mate_s = *config_.mate_s,
          .effort = static_cast<std::size_t>(config_.effort)};
}

/// Sets up the teams and everything else that depends on the boxes.
void StarPlanner::survey_site(const PlannerInput& in) {
  const StarShare share{.volume_weight = config_.volume_weight, .objective = config_.share};
  const StarTeam team = own_team(agent_.fleet, agent_.self, in.boxes, share, *config_.helps);
  team_ = team.uavs;
  boxes_ = team.boxes;
  known_.emplace(config_, agent_, in.boxes, boxes_);
  if (!has_lidar()) at_box_ = boxes_.size();
}

void StarPlanner::look_around(const PlannerInput& in) {
  const PartTimer timer(in.parts, "planner/map and pictures");
  if (in.k % kCameraSteps == 0 && in.tracking.airborne) known_->look_at_picture(in.state, in.gimbal);
  if (agent_.due(in.k, WorldVoxels::kUpdateS, agent_.self)) known_->look_at_map(*in.world_map, in.state.p_WB);
}

/// A failed route is put off, and removed together with those before it, which the flight core has tried before.
void StarPlanner::handle_outcome(const Outcome& outcome, const PlannerInput& in) {
  const auto ended = std::ranges::find(routes_, outcome.id, &Route::id);
  if (ended == routes_.end()) return;
  if (outcome.kind == Outcome::Kind::reached) return routes_.clear();
  put_off(*ended, in);
  routes_.erase(routes_.begin(), ended + 1);
  if (outcome.kind == Outcome::Kind::blocked) careful_until_ = in.tick + ticks(kCarefulS);
}

void StarPlanner::put_off(const Route& route, const PlannerInput& in) {
  if (!route.views.empty()) known_->surfaces().failed(route.views.front(), in.tick);
  if (!route.goals.empty()) known_->explorer().failed(route.goals.front(), in.tick);
}

/// Whether the first target of the route is done, by any UAV, or its place is reached. A target that is reached but not
/// done is put off: the UAV does not stop for it.
bool StarPlanner::target_done(const PlannerInput& in) {
  Route& route = routes_.front();
  if (route.beside_W) return false;
  const bool open = route.views.empty() ? known_->explorer().open(route.goals.front())
                                        : StarSurfaces::open(known_->grid(), route.views.front());
  const bool reached = (route.places_W().front() - in.state.p_WB).norm() < kReachedM;
  if (open && !reached) return false;
  if (open) put_off(route, in);
  if (!route.views.empty()) route.views.erase(route.views.begin());
  if (route.views.empty() && route.goals.empty()) routes_.clear();
  return true;
}

/// Plans again every replan_s, or sooner when the target is done; the flight goes on without a stop.
void StarPlanner::carry_on(const PlannerInput& in, PlannerOutput& out) {
  const double since = seconds(in.tick - planned_at_);
  const bool done = routes_.empty() || target_done(in);
  const bool on_approach = !routes_.empty() && routes_.front().beside_W;
  const bool due = since >= (on_approach ? 2.0 : 1.0) * config_.replan_s || (done && since >= config_.covered_s);
  if (due) decide(in, out);
}

void StarPlanner::decide(const PlannerInput& in, PlannerOutput& out) {
  planned_at_ = in.tick;
  if (at_box_ < boxes_.size()) {
    explore(in, out);
  } else if (!inspects() || !inspect(in, out)) {
    idle(in, out);
  }
}

/// Offers routes through the frontiers of the current box; if none is left, goes on to the next box.
void StarPlanner::explore(const PlannerInput& in, PlannerOutput& out) {
  StarStart start{in.tracking.setpoint.p_WB, in.tracking.setpoint.v_WB, {}};
  start.mates_W = talk_.goals_W(in.tick);
  const std::size_t box = boxes_[at_box_];
  const std::vector<StarGoal> goals = timed(in.parts, "planner/frontiers", [&] {
    return known_->explorer().tour(known_->grid(), *in.space, in.boxes[box], start, in.tick);
  });
  if (goals.empty()) {
    if (been_there_) return begin_box(at_box_ + 1);
    if (routes_.empty() || !routes_.front().beside_W) approach(in, box, out);
    return;
  }
  been_there_ = true;
  std::vector<Route> routes;
  for (std::size_t first = 0; first < std::min(goals.size(), kCandidates); ++first) {
    routes.push_back({.goals = {goals.begin() + static_cast<std::ptrdiff_t>(first), goals.end()}});
  }
  offer(std::move(routes), config_.explore_mps, in, out);
}

/// Offers routes through the viewpoints of surface left to inspect. @returns false if there is none.
bool StarPlanner::inspect(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  const std::vector<StarView> views =
      timed(in.parts, "planner/views", [&] { return known_->views(*in.space, here, in.tick); });
  if (views.empty()) return false;
  std::vector<Vector3d> places;
  for (const StarView& view : views) places.push_back(view.p_WB);
  const StarTour tour = timed(in.parts, "planner/tours", [&] {
    return hierarchical_tour(known_->grid(), here, in.tracking.setpoint.v_WB, places, last_cluster_W_,
                             talk_.goals_W(in.tick), tour_config());
  });
  std::vector<Route> routes;
  for (std::size_t first = 0; first < std::min(views.size(), kCandidates); ++first) {
    Route& route = routes.emplace_back();
    for (std::size_t i = first; i < tour.visits.size(); ++i) route.views.push_back(views[tour.visits[i]]);
  }
  offer(std::move(routes), config_.inspect_mps, in, out);
  last_cluster_W_ = tour.first_cluster_W;
  idle_since_.reset();
  return true;
}

/// Offers places beside a box of which the map shows no frontier that can be explored.
void StarPlanner::approach(const PlannerInput& in, std::size_t box, PlannerOutput& out) {
  if (++approaches_ > kMaxApproaches) {
    been_there_ = true;
    return;
  }
  const auto places = places_beside(in.boxes[box], *in.space, in.tracking.setpoint.p_WB);
  // Each approach comes from another side.
  const std::size_t first_side = kSidesApart * static_cast<std::size_t>(approaches_ - 1) + rounds_;
  std::vector<Route> routes;
  for (std::size_t i = 0; i < std::min(places.size(), kCandidates); ++i) {
    routes.push_back({.beside_W = places[(first_side + i) % places.size()]});
  }
  offer(std::move(routes), config_.flight.approach_mps, in, out);
}

/// Hovers until there is new surface to inspect. If there is none for follow_s, a photographer flies to its explorer's
/// box or one of the team's, in turn, and an explorer begins one of its boxes again.
void StarPlanner::idle(const PlannerInput& in, PlannerOutput& out) {
  if (!routes_.empty() && routes_.front().beside_W) return;
  if (!idle_since_) idle_since_ = in.tick;
  const bool waits = seconds(in.tick - *idle_since_) < *config_.follow_s;
  if (boxes_.empty() || waits) return hover(in, out);
  idle_since_ = in.tick;
  if (*config_.helps && !helps_others_ && team_is_done()) return help_others(in);
  if (has_lidar()) {
    begin_box(rounds_ % boxes_.size());
    ++rounds_;
    return;
  }
  const auto word = talk_.word(team_.front());
  const bool to_leader = word && word->box < in.boxes.size() && rounds_ % 2 == 0;
  const std::size_t box = to_leader ? word->box : boxes_[rounds_ / 2 % boxes_.size()];
  ++rounds_;
  approaches_ = 0;
  approach(in, box, out);
}

/// Whether the team's explorer has explored all its boxes, or works on another team's already.
bool StarPlanner::team_is_done() const {
  const auto word = talk_.word(team_.front());
  return has_lidar() || (word && (word->explored || std::ranges::count(boxes_, word->box) == 0));
}

/// Adds the other teams' boxes to the team's, nearest first; an explorer begins the first of them.
void StarPlanner::help_others(const PlannerInput& in) {
  helps_others_ = true;
  const auto is_own = [&](std::size_t box) { return std::ranges::count(boxes_, box) > 0; };
  std::vector<std::size_t> others;
  for (std::size_t box = 0; box < in.boxes.size(); ++box) {
    if (!is_own(box)) others.push_back(box);
  }
  std::ranges::stable_sort(others, {}, [&](std::size_t box) { return (in.boxes[box].center - in.state.p_WB).norm(); });
  if (others.empty()) return;
  const std::size_t own = boxes_.size();
  boxes_.insert(boxes_.end(), others.begin(), others.end());
  known_->work_on(in.boxes, boxes_);
  begin_box(has_lidar() ? own : boxes_.size());
}

/// The team member that this UAV waits for: a photographer for its explorer, an explorer for its first photographer.
std::optional<std::size_t> StarPlanner::awaited() const {
  if (team_.size() < 2) return std::nullopt;
  return team_[has_lidar() ? 1 : 0];
}

void StarPlanner::begin_box(std::size_t box) {
  at_box_ = box;
  approaches_ = 0;
  been_there_ = false;
  routes_.clear();
}

/// Makes the present place the goal: without any goal, the flight core would begin a recovery behaviour.
void StarPlanner::hover(const PlannerInput& in, PlannerOutput& out) {
  routes_.clear();
  out.goals = std::vector<Goal>{{.id = ++id_, .way = {{in.tracking.setpoint.p_WB, config_.inspect_mps}}}};
}

/// Offers routes to the flight core as goals, best first.
void StarPlanner::offer(std::vector<Route> routes, double speed_mps, const PlannerInput& in, PlannerOutput& out) {
  std::vector<Goal> goals;
  for (Route& route : routes) goals.push_back(goal_of(route, goals.empty(), speed_mps, in));
  routes_ = std::move(routes);
  out.goals = std::move(goals);
}

/// A goal that leads straight through the route's places, as far as possible. If the first place cannot be reached
/// straight, the flight core searches a path to it.
Goal StarPlanner::goal_of(Route& route, bool is_first, double speed_mps, const PlannerInput& in) {
  const PartTimer timer(in.parts, "planner/ways");
  const StarWayConfig config{.round_m = config_.round_m,
                             .horizon_m = config_.horizon_m,
                             .speed_mps = speed_mps,
                             .transit_mps = config_.flight.approach_mps};
  const Vector3d here = in.tracking.setpoint.p_WB;
  const std::vector<Vector3d> places = route.places_W();
  Goal goal;
  if (in.tick >= careful_until_) goal.way = star_way(*in.space, here, places, config);
  const bool is_straight = !goal.way.empty();
  if (!is_straight) {
    goal.way = star_way(*in.space, places.front(), {places.begin() + 1, places.end()}, config);
    goal.way.insert(goal.way.begin(), {places.front(), config_.flight.approach_mps});
  }
  // A goal with the id of the current one continues its flight without a stop; any other goal begins here.
  const bool goes_on = is_first && in.flight.goal && (is_straight || !in.flight.on_way);
  if (is_straight && !(goes_on && in.flight.on_way)) goal.way.insert(goal.way.begin(), {here, speed_mps});
  goal.id = route.id = goes_on ? *in.flight.goal : ++id_;
  return goal;
}

/// Points the camera: on the way to a view at its surface; otherwise, if the UAV inspects, at surface that it passes,
/// or else at the frontier that it explores.
void StarPlanner::point_camera(const PlannerInput& in, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/camera");
  if (!in.tracking.airborne) return;
  if (!routes_.empty() && !routes_.front().views.empty()) {
    const StarView& view = routes_.front().views.front();
    camera_.sweep(in.state, in.gimbal, view.p_WB, view.surface_W, out);
  } else if (in.k % kCameraSteps == 0) {
    auto target = inspects() ? known_->nearest_open_W(in.state.p_WB) : std::nullopt;
    if (!target && !routes_.empty() && !routes_.front().goals.empty()) target = routes_.front().goals.front().middle_W;
    if (target) camera_.look_at(in.state, *target, out);
  }
}

StarTalk::Word StarPlanner::own_word() const {
  StarTalk::Word word;
  word.explored = at_box_ >= boxes_.size();
  word.box = boxes_.empty() ? 0 : boxes_[std::min(at_box_, boxes_.size() - 1)];
  if (routes_.empty()) return word;
  const Route& route = routes_.front();
  if (!route.views.empty()) word.goal_W = last_cluster_W_;
  if (!route.goals.empty()) word.goal_W = route.goals.front().middle_W;
  return word;
}

SKEIN_REGISTER_PLANNER("star", StarPlanner);

}  // namespace skein::agent
