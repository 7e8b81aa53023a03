// STAR: the strategy of the team that came third in the first contest, rebuilt from its published description.
//
// 1. Balanced teams of one explorer and its photographers; boxes go to teams by a multiple travelling salesmen problem
//    over way and volume (teams.hpp), once and for all. 2. Explorers go through their team's boxes by frontiers:
//    one viewpoint for each cluster, an ATSP over them (explorer.hpp). 3. What they find reaches the others in
//    chunks (talk.hpp). 4. Photographers begin at once: viewpoints before known surface that nobody has inspected
//    (surfaces.hpp), in clusters, by a hierarchical ATSP (tour.hpp); without any they hover. 5. Everybody
//    flies on through its viewpoints without a stop, turning and tilting the camera all the time, and plans anew every
//    1.5 s; so pictures are blurred and oblique.
//
// Its weaknesses are the published ones: boxes are shared out by volume and never again, empty volume is explored like
// any other, photographers begin late, and pictures are taken in motion. `faithful` brings back what else the sources
// tell or leave out: photographers without surface hover for ever where they are, out of sight as they may be; an
// explorer that has seen everything is done, and a team without a box has nothing to do; UAVs of one team plan without
// regard to where the others are about to work. Collisions at the start, which are published, are not brought back.
// Not published for this contest, and so our choice: all numbers (config.hpp), the messages, and safety.
#include <algorithm>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/proof.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight/sortie.hpp"
#include "uav_agent/planners/star/camera.hpp"
#include "uav_agent/planners/star/knowledge.hpp"
#include "uav_agent/planners/star/talk.hpp"
#include "uav_agent/planners/star/teams.hpp"
#include "uav_agent/planners/star/tour.hpp"
#include "uav_agent/planners/star/way.hpp"

namespace skein::agent {
namespace {

constexpr double kLookAtMapS = 1.0;        ///< between two looks at what the LiDARs saw
constexpr std::uint64_t kCameraSteps = 4;  ///< exchanges between two looks at what the camera saw
constexpr double kAboveBlindM = 2.0;
constexpr double kReachedM = 1.0;       ///< a place is reached this near to it
constexpr double kRestS = 1.0;          ///< when there is nothing to do
constexpr std::size_t kCandidates = 3;  ///< first places tried in one plan
constexpr int kMaxApproaches = 4;       ///< to a box
constexpr std::size_t kSidesApart = 3;  ///< between two of them, of twelve
constexpr int kFruitlessToBold = 2, kFruitlessToRetreat = 9;
constexpr double kBoldS = 40.0;  ///< for so long it does with less proof of free space

}  // namespace

class StarPlanner final : public Planner {
 public:
  using Config = StarConfig;

  StarPlanner(const Config& config, const AgentConfig& agent)
      : config_(config),
        agent_(agent),
        sortie_({.climb_mps = config.climb_mps,
                 .transit_mps = config.transit_mps,
                 .retreat_mps = config.transit_mps,
                 .clearance_m = config.clearance_m,
                 .deliver_every_s = config.deliver_every_s,
                 .return_margin_s = config.return_margin_s},
                agent_),
        separation_(Separation::Config(), agent_),
        talk_({.share_s = config.share_s}, agent_) {}

  PlannerOutput plan(const PlannerInput& in) override;

 private:
  /// What it flies to, one after the other. Either views or goals are not empty, or none is.
  struct Route {
    std::vector<StarView> views;
    std::vector<StarGoal> goals;
    bool empty() const { return views.empty() && goals.empty(); }
  };

  bool has_lidar() const { return agent_.me().role == Role::explorer; }
  FreeSpace::Config space_config() const;
  StarTourConfig tour_config() const;

  void survey_site(const PlannerInput& in);
  void look_around(const PlannerInput& in);
  void carry_on(const PlannerInput& in, PlannerOutput& out);
  bool target_done(const PlannerInput& in);
  void decide(const PlannerInput& in, PlannerOutput& out);
  bool explore(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  bool inspect(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  bool approach(const PlannerInput& in, const FreeSpace& space, std::size_t box, PlannerOutput& out);
  void idle(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out);
  void begin_box(std::size_t box);
  void nothing_to_reach(const PlannerInput& in, PlannerOutput& out);
  bool fly_through(const std::vector<Vector3d>& places_W, double speed_mps, const FreeSpace& space,
                   const PlannerInput& in, PlannerOutput& out);
  void forget_target();
  void point_camera(const PlannerInput& in, PlannerOutput& out);
  StarTalk::Word own_word() const;

  const Config config_;
  const AgentConfig agent_;
  Sortie sortie_;
  Separation separation_;
  StarTalk talk_;
  StarCamera camera_;
  Proof proof_;

  std::optional<StarKnowledge> known_;  ///< once the boxes have come, as all that follows
  std::size_t leader_ = 0;              ///< of the team
  std::vector<std::size_t> boxes_;      ///< of the team, in the order of visit
  Site site_;

  std::size_t at_box_ = 0;  ///< index into boxes_; the end: explored
  int approaches_ = 0;      ///< to this box
  bool been_there_ = false;
  Route route_;
  std::optional<Vector3d> last_cluster_W_;
  Tick planned_at_ = 0, not_before_ = 0;
  std::optional<Tick> idle_since_;
  std::size_t rounds_ = 0;  ///< after times without anything to do
  int fruitless_ = 0;       ///< decisions in a row
};

PlannerOutput StarPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !known_) survey_site(in);
  if (known_) {
    talk_.listen(in, known_->grid());
    look_around(in);
  }
  switch (sortie_.step(in, space_config(), out)) {
    case Sortie::Turn::nothing:
      break;
    case Sortie::Turn::begin:
      forget_target();
      decide(in, out);
      break;
    case Sortie::Turn::work:
    case Sortie::Turn::detour:
      carry_on(in, out);
      break;
    case Sortie::Turn::blocked:
      if (!route_.views.empty()) known_->surfaces().failed(route_.views.front(), in.tick);
      if (!route_.goals.empty()) known_->explorer().failed(route_.goals.front(), in.tick);
      forget_target();
      not_before_ = in.tick + ticks(kRestS);
      break;
    case Sortie::Turn::leave:
      forget_target();
      break;
  }
  if (known_) {
    point_camera(in, out);
    talk_.speak(in, known_->grid(), own_word(), out);
  }
  return out;
}

FreeSpace::Config StarPlanner::space_config() const {
  FreeSpace::Config config;
  config.clearance_m = centre_clearance_m(agent_, config_.clearance_m);
  config.rays = proof_.of(Proof::rays(site_.roomy), agent_.me().role);
  config.blind_height_m = site_.safe_height_m();
  config.floor_m = std::max(config.floor_m, site_.lowest_m);
  config.hearsay = known_ ? known_->hearsay() : nullptr;
  return config;
}

StarTourConfig StarPlanner::tour_config() const {
  return {.speed_mps = config_.inspect_mps,
          .turn_s = config_.turn_s,
          .radius_m = config_.view_radius_m,
          .history_s = config_.history_s,
          .mate_s = config_.mate_s,
          .effort = static_cast<std::size_t>(config_.effort)};
}

/// The teams, and all that follows from the boxes.
void StarPlanner::survey_site(const PlannerInput& in) {
  site_ = site_of(agent_, in.boxes, config_.blind_height_ratio);
  sortie_.know_site(site_.top_m, site_.safe_height_m());
  const StarTeam team = own_team(agent_.fleet, agent_.self, in.boxes, config_.volume_weight, !config_.faithful);
  leader_ = team.uavs.front();
  boxes_ = team.boxes;
  known_.emplace(config_, agent_, site_, in.boxes, boxes_);
  if (!has_lidar()) at_box_ = boxes_.size();
}

void StarPlanner::look_around(const PlannerInput& in) {
  if (in.k % kCameraSteps == 0 && sortie_.working()) known_->look_at_picture(in.state, in.gimbal);
  if (agent_.due(in.k, kLookAtMapS, agent_.self)) known_->look_at_map(in.map, in.state.p_WB);
}

void StarPlanner::forget_target() {
  route_ = {};
  idle_since_.reset();
}

/// Whether the first of what it flies to has been seen to, by whomever, or reached. What could not be seen to from
/// there is put off: it does not stop for it.
bool StarPlanner::target_done(const PlannerInput& in) {
  const auto reached = [&](const Vector3d& p) { return (p - in.state.p_WB).norm() < kReachedM; };
  if (!route_.views.empty()) {
    const StarView view = route_.views.front();
    const bool open = StarSurfaces::open(known_->grid(), view);
    if (open && !reached(view.p_WB)) return false;
    if (open) known_->surfaces().failed(view, in.tick);
    route_.views.erase(route_.views.begin());
    return true;
  }
  if (route_.goals.empty()) return false;
  const StarGoal& goal = route_.goals.front();
  const bool open = known_->explorer().open(goal);
  if (open && !reached(goal.p_WB)) return false;
  if (open) known_->explorer().failed(goal, in.tick);
  return true;
}

/// Plans anew now and then, or when something is done; the way goes on without a stop.
void StarPlanner::carry_on(const PlannerInput& in, PlannerOutput& out) {
  const double since = seconds(in.tick - planned_at_);
  const bool done = target_done(in) || in.tracking.done;
  const bool on_approach = route_.empty() && !in.tracking.done;
  const bool due = since >= (on_approach ? 2.0 : 1.0) * config_.replan_s || (done && since >= config_.covered_s);
  if (due && in.tick >= not_before_) decide(in, out);
}

void StarPlanner::decide(const PlannerInput& in, PlannerOutput& out) {
  if (!known_) return;
  planned_at_ = in.tick;
  proof_.settle(in.tick);
  const FreeSpace space(space_config(), in.boxes, in.map,
                        separation_.keep_out(in.tick, in.tracking.setpoint.p_WB, in.peers));
  if (at_box_ < boxes_.size()) {
    explore(in, space, out) ? void(fruitless_ = 0) : nothing_to_reach(in, out);
  } else if (has_lidar() && config_.faithful) {
    idle(in, space, out);
  } else if (!inspect(in, space, out)) {
    idle(in, space, out);
  }
}

/// On through the frontiers of this box; when there is none left, on to the next box.
bool StarPlanner::explore(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  StarStart start{in.tracking.setpoint.p_WB, in.tracking.setpoint.v_WB, {}};
  if (!config_.faithful) start.mates_W = talk_.goals_W(in.tick);
  const std::size_t box = boxes_[at_box_];
  std::vector<StarGoal> goals = known_->explorer().tour(known_->grid(), space, in.boxes[box], start, in.tick);
  if (goals.empty()) {
    if (!been_there_) {
      if (!route_.empty() || in.tracking.done) return approach(in, space, box, out);
      return true;  // on its way there
    }
    begin_box(at_box_ + 1);
    return true;
  }
  been_there_ = true;
  for (std::size_t first = 0; first < std::min(goals.size(), kCandidates); ++first) {
    std::vector<Vector3d> places;
    for (std::size_t i = first; i < goals.size(); ++i) places.push_back(goals[i].p_WB);
    if (fly_through(places, config_.explore_mps, space, in, out)) {
      goals.erase(goals.begin(), goals.begin() + static_cast<std::ptrdiff_t>(first));
      route_ = {{}, std::move(goals)};
      return true;
    }
    known_->explorer().failed(goals[first], in.tick);
  }
  return false;
}

/// On through the viewpoints of surface that is left. @returns false if there is none.
bool StarPlanner::inspect(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  const std::vector<StarView> views = known_->views(space, here, in.tick);
  if (views.empty()) return false;
  std::vector<Vector3d> places;
  for (const StarView& view : views) places.push_back(view.p_WB);
  const std::vector<Vector3d> mates = config_.faithful ? std::vector<Vector3d>() : talk_.goals_W(in.tick);
  const StarTour tour =
      hierarchical_tour(known_->grid(), here, in.tracking.setpoint.v_WB, places, last_cluster_W_, mates, tour_config());
  for (std::size_t first = 0; first < std::min(views.size(), kCandidates); ++first) {
    std::vector<Vector3d> on_way;
    Route route;
    for (std::size_t i = first; i < tour.visits.size(); ++i) {
      on_way.push_back(views[tour.visits[i]].p_WB);
      route.views.push_back(views[tour.visits[i]]);
    }
    if (fly_through(on_way, config_.inspect_mps, space, in, out)) {
      route_ = std::move(route);
      last_cluster_W_ = tour.first_cluster_W;
      fruitless_ = 0;
      idle_since_.reset();
      return true;
    }
    known_->surfaces().failed(views[tour.visits[first]], in.tick);
  }
  nothing_to_reach(in, out);
  return true;
}

/// To a place beside a box of which nothing is known yet.
bool StarPlanner::approach(const PlannerInput& in, const FreeSpace& space, std::size_t box, PlannerOutput& out) {
  route_ = {};
  if (++approaches_ > kMaxApproaches) {
    been_there_ = true;
    return true;
  }
  const auto places =
      places_beside(in.boxes[box], space, in.tracking.setpoint.p_WB, site_.safe_height_m() + kAboveBlindM);
  // From another side each time.
  const std::size_t first = kSidesApart * static_cast<std::size_t>(approaches_ - 1) + rounds_;
  for (std::size_t i = 0; i < std::min(places.size(), kCandidates); ++i) {
    const Vector3d& place = places[(first + i) % places.size()];
    if (fly_through({place}, config_.transit_mps, space, in, out)) return true;
  }
  return false;
}

/// Hovers until new surface comes. Where none comes for a while, photographers go where their explorer is, explorers
/// look at their boxes from other sides, and both are content with less proof of free space.
void StarPlanner::idle(const PlannerInput& in, const FreeSpace& space, PlannerOutput& out) {
  if (!idle_since_) {
    idle_since_ = in.tick;
    route_ = {};
    sortie_.pilot().stop(out);
  }
  const bool waits = !in.tracking.done || seconds(in.tick - *idle_since_) < config_.follow_s;
  if (config_.faithful || boxes_.empty() || waits) return;
  idle_since_ = in.tick;
  proof_.ask_less(in.tick + ticks(kBoldS));
  if (has_lidar()) {
    begin_box(rounds_ % boxes_.size());
    ++rounds_;
    return;
  }
  const auto word = talk_.word(leader_);
  const bool to_leader = word && word->box < in.boxes.size() && rounds_ % 2 == 0;
  const std::size_t box = to_leader ? word->box : boxes_[rounds_ / 2 % boxes_.size()];
  ++rounds_;
  approaches_ = 0;
  approach(in, space, box, out);
}

void StarPlanner::begin_box(std::size_t box) {
  at_box_ = box;
  approaches_ = 0;
  been_there_ = false;
  route_ = {};
}

void StarPlanner::nothing_to_reach(const PlannerInput& in, PlannerOutput& out) {
  forget_target();
  sortie_.pilot().stop(out);
  not_before_ = in.tick + ticks(kRestS);
  ++fruitless_;
  if (fruitless_ % kFruitlessToBold == 0) proof_.ask_less(in.tick + ticks(kBoldS));
  if (fruitless_ % kFruitlessToRetreat == 0) sortie_.pilot().retreat(in, out);
}

/// Sets out through places one after the other; false if there is no way to the first.
bool StarPlanner::fly_through(const std::vector<Vector3d>& places_W, double speed_mps, const FreeSpace& space,
                              const PlannerInput& in, PlannerOutput& out) {
  auto path = star_way(known_->grid(), space, in.boxes, in.tracking.setpoint.p_WB, places_W, speed_mps,
                       {config_.round_m, config_.horizon_m, config_.transit_mps});
  if (!path) {
    sortie_.pilot().no_way(places_W.front(), space, out);
    return false;
  }
  sortie_.pilot().follow(std::move(*path), in, out);
  return true;
}

/// Explorers photograph what they pass, photographers what they fly to.
void StarPlanner::point_camera(const PlannerInput& in, PlannerOutput& out) {
  if (!sortie_.working() || sortie_.looks_around(in.tick)) return;
  if (!route_.views.empty()) {
    const StarView& view = route_.views.front();
    camera_.sweep(in.state, in.gimbal, view.p_WB, view.surface_W, out);
  } else if (in.k % kCameraSteps == 0) {
    auto passed = known_->nearest_open_W(in.state.p_WB);
    if (!passed && !route_.goals.empty()) passed = route_.goals.front().middle_W;
    if (passed) camera_.look_at(in.state, *passed, out);
  }
}

StarTalk::Word StarPlanner::own_word() const {
  StarTalk::Word word;
  word.explored = at_box_ >= boxes_.size();
  word.box = boxes_.empty() ? 0 : boxes_[std::min(at_box_, boxes_.size() - 1)];
  if (!route_.views.empty() && last_cluster_W_) word.goal_W = last_cluster_W_;
  if (!route_.goals.empty()) word.goal_W = route_.goals.front().middle_W;
  return word;
}

SKEIN_REGISTER_PLANNER("star", StarPlanner);

}  // namespace skein::agent
