// Patrol: flies along every face of every box in strips, at the distance where the camera is sharp. It knows
// the boxes and its own map, talks to nobody, and is meant as an honest baseline: simple, safe, the same on
// every UAV.
//
// In turn: lift off straight up, each UAV to a height of its own; explorers fly once around everything; then
// each UAV flies its share of the strips (strips.hpp), closing in on the real surface as the map fills
// (standoff.hpp), goes to where the station sees it from time to time and in good time before the end
// (sortie.hpp), and begins its share again with the camera turned a little. In a box that is too large to say
// where the structure is, the strips come from the map (block_work.hpp). Whatever it does, it stops before
// anything that the map shows in its way, and gives way.
#include <algorithm>
#include <cmath>

#include "core/euler.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/proof.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight/sortie.hpp"
#include "uav_agent/planners/patrol/config.hpp"
#include "uav_agent/planners/patrol/rounds.hpp"
#include "uav_agent/planning/block_work.hpp"
#include "uav_agent/planning/standoff.hpp"
#include "uav_agent/planning/survey.hpp"
#include "uav_agent/planning/work_share.hpp"

namespace skein::agent {
namespace {

constexpr double kRefitS = 2.0;                      ///< between two looks at the map while on a strip
constexpr double kRestS = 3.0;                       ///< after a round in which no strip could be flown
constexpr double kLookAroundTurn = 0.8;              ///< meanwhile [rad]
constexpr double kViewTurns[] = {0.0, 0.45, -0.45};  ///< of the camera to the side, by round [rad]
constexpr int kMaxFailures = 3;
constexpr int kMaxFailedTasks = 8;

}  // namespace

class PatrolPlanner final : public Planner {
 public:
  using Config = PatrolConfig;

  PatrolPlanner(const Config& config, const AgentConfig& agent)
      : config_(config),
        agent_(agent),
        reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)),
        sortie_({config.climb_mps, config.transit_mps, config.survey_mps, config.clearance_m, config.deliver_every_s,
                 config.return_margin_s},
                agent_) {}

  PlannerOutput plan(const PlannerInput& in) override;

 private:
  enum class Phase { survey, transit, strip, idle };

  FreeSpace::Config space_config() const;
  FreeSpace free_space(const PlannerInput& in) const { return {space_config(), in.boxes, in.map}; }
  StandoffConfig standoff_config() const;
  void share_work(const PlannerInput& in);
  void left_strip();
  void blocked(const PlannerInput& in, PlannerOutput& out);
  void carry_on(const PlannerInput& in, PlannerOutput& out);
  void begin_survey(const PlannerInput& in, PlannerOutput& out);
  void next_strip(const PlannerInput& in, PlannerOutput& out);
  void approach(const PlannerInput& in, PlannerOutput& out);
  void fly_strip(const PlannerInput& in, PlannerOutput& out);
  void refit(const PlannerInput& in, PlannerOutput& out);
  void face_strip(PlannerOutput& out) const;
  bool next_block(const PlannerInput& in, PlannerOutput& out);
  void idle(Tick until, PlannerOutput& out);
  /// Where on the strip the waypoint `leg` of the present run is.
  double run_s(std::size_t leg) const { return strip_s_ + standoff_config().step_m * static_cast<double>(leg); }

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;
  Sortie sortie_;

  Phase phase_ = Phase::idle;
  Tick idle_until_ = 0;
  int failures_ = 0;  ///< of this strip
  bool surveyed_ = false;

  bool shared_ = false;  ///< the boxes have come
  double top_m_ = 0.0, blind_height_m_ = 0.0;
  PatrolRounds rounds_;
  bool flown_any_ = true;  ///< in this round
  Proof proof_;            ///< of free space
  std::optional<BlockWork> blocks_;
  std::optional<BlockWork::Task> task_;  ///< of blocks_; else the current strip is of the rounds
  bool task_flown_ = false;
  int failed_tasks_ = 0;        ///< one after the other
  Strip strip_;                 ///< the current one
  bool reversed_ = false;       ///< its direction
  double strip_s_ = 0.0;        ///< where on the strip the present run begins
  std::size_t run_length_ = 0;  ///< waypoints of it
  Tick refit_at_ = 0;
};

PlannerOutput PatrolPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !shared_) share_work(in);
  switch (sortie_.step(in, space_config(), out)) {
    case Sortie::Turn::begin:
      surveyed_ ? idle(in.tick, out) : begin_survey(in, out);
      break;
    case Sortie::Turn::work:
      carry_on(in, out);
      break;
    case Sortie::Turn::detour:
      if (phase_ == Phase::strip) left_strip();
      break;
    case Sortie::Turn::blocked:
      blocked(in, out);
      break;
    case Sortie::Turn::nothing:
    case Sortie::Turn::leave:
      break;
  }
  return out;
}

FreeSpace::Config PatrolPlanner::space_config() const {
  FreeSpace::Config config;
  config.clearance_m = centre_clearance_m(agent_, config_.clearance_m);
  config.use_map = config_.use_map;
  config.jut_m = 0.0;  // it works at a fixed distance from the boxes' faces, seen or not
  const bool roomy = blocks_ && blocks_->any();
  config.rays = proof_.of(Proof::rays(roomy), agent_.me().role);
  if (roomy) {
    config.enter_radius_m = kAnywhereM;  // ways through a roomy box do not lead through a building
  }
  config.blind_height_m = blind_height_m_;
  return config;
}

StandoffConfig PatrolPlanner::standoff_config() const {
  StandoffConfig config;
  config.ratio = config_.standoff_ratio;
  config.blind_ratio = config_.blind_ratio;
  config.speed_gain = config_.speed_gain;
  config.max_speed_mps = config_.transit_mps;
  return config;
}

void PatrolPlanner::share_work(const PlannerInput& in) {
  shared_ = true;
  const Site site = site_of(agent_, in.boxes, config_.blind_height_ratio);
  top_m_ = site.top_m;
  const bool by_map = !site.blind_fleet && config_.use_map;
  if (by_map) blind_height_m_ = site.blind_height_m;
  sortie_.know_site(top_m_, blind_height_m_);
  WorkShareConfig config;
  config.strips.standoff_ratio = config_.standoff_ratio;
  config.strips.overlap = config_.overlap;
  config.strips.top = config_.top;
  config.strips.bottom = config_.bottom;
  config.standoff = standoff_config();
  config.transit_mps = config_.transit_mps;
  config.survey = config_.survey && config_.use_map;
  config.survey_standoff_m = config_.survey_standoff_m;
  config.survey_mps = config_.survey_mps;
  const BlockWork::Config blocks{.strips = config.strips, .transit_mps = config_.transit_mps};
  blocks_.emplace(blocks, agent_, reach_, by_map ? in.boxes : std::vector<OrientedBox>());
  std::vector<OrientedBox> tight = in.boxes;
  if (by_map) std::erase_if(tight, is_roomy);
  rounds_.know_share(own_share(agent_, tight, reach_, 0.5 * top_m_, config));
}

/// The detour ends with the rest of this run; what comes behind it is fitted there.
void PatrolPlanner::left_strip() {
  strip_s_ = run_s(run_length_);
  phase_ = Phase::transit;
}

/// Something came between this UAV and what it was about.
void PatrolPlanner::blocked(const PlannerInput& in, PlannerOutput& out) {
  const bool obstacle = sortie_.situation() == Situation::obstacle;
  if (obstacle && phase_ == Phase::strip) {
    strip_s_ = run_s(in.tracking.leg);
    phase_ = Phase::transit;  // at its end already: fits the rest of the strip anew
    return;
  }
  const bool on_strip = phase_ == Phase::transit || phase_ == Phase::strip;
  const bool of_round = on_strip && !task_;  // of a block: is offered again anyway
  if (of_round && !obstacle) rounds_.again_last();
  if (of_round && obstacle && ++failures_ <= kMaxFailures) rounds_.again_next();
  idle(in.tick, out);
}

void PatrolPlanner::carry_on(const PlannerInput& in, PlannerOutput& out) {
  switch (phase_) {
    case Phase::survey:
      if (in.tracking.done) idle(in.tick, out);
      return;
    case Phase::transit:
      if (in.tracking.done) fly_strip(in, out);
      return;
    case Phase::strip:
      if (in.tracking.done) {
        strip_s_ = run_s(run_length_);
        approach(in, out);
      } else if (in.tick >= refit_at_) {
        refit(in, out);
      }
      return;
    case Phase::idle:
      if (in.tick >= idle_until_ && in.tracking.done) next_strip(in, out);
      return;
  }
}

void PatrolPlanner::idle(Tick until, PlannerOutput& out) {
  phase_ = Phase::idle;
  idle_until_ = until;
  sortie_.pilot().stop(out);
}

void PatrolPlanner::begin_survey(const PlannerInput& in, PlannerOutput& out) {
  surveyed_ = true;
  idle(in.tick, out);
  if (!config_.survey || !config_.use_map) return;
  const FreeSpace space = free_space(in);
  const double height = std::max(blind_height_m_ + 2.0, 0.5 * top_m_);
  Path path;
  Vector3d at = in.tracking.setpoint.p_WB;
  const std::vector<Vector3d> ring = survey_ring(agent_, in.boxes, config_.survey_standoff_m, height);
  for (const Vector3d& corner : ring) {
    const auto way = find_path(space, in.boxes, at, corner);
    if (!way) continue;
    for (const Vector3d& p : *way) path.waypoints.push_back({p, config_.survey_mps});
    at = corner;
  }
  if (path.waypoints.empty()) {
    // From a narrow start nothing can be reached yet: the sortie is told where it wished to be.
    surveyed_ = ring.empty() || sortie_.pilot().fly_to(ring.front(), in, space_config(), out);
    return;
  }
  phase_ = Phase::survey;
  sortie_.pilot().follow(std::move(path), in, out);
}

/// Takes up a strip in a block, or waits for the map to show one. @returns false if there is other work.
bool PatrolPlanner::next_block(const PlannerInput& in, PlannerOutput& out) {
  if (task_ && !task_flown_) {
    blocks_->failed(*task_, in.tick);
    if (++failed_tasks_ % kMaxFailedTasks == 0) proof_.ask_less();
  }
  task_ = blocks_->next(in.tick, in.tracking.setpoint.p_WB, in.map);
  const bool again = task_ && task_->flown > rounds_.number();
  if (!rounds_.without_work() && (!task_ || again)) return false;
  if (!task_) {
    idle(in.tick + ticks(kRestS), out);
    return true;
  }
  task_flown_ = false;
  strip_ = task_->strip;
  reversed_ = task_->reversed;
  strip_s_ = 0.0;
  approach(in, out);
  return true;
}

void PatrolPlanner::next_strip(const PlannerInput& in, PlannerOutput& out) {
  const bool shares_done = rounds_.over() && (rounds_.number() >= 0 || rounds_.without_work());
  if (blocks_->any() && shares_done && next_block(in, out)) return;
  task_.reset();
  if (rounds_.over() && !flown_any_ && !rounds_.without_work()) {
    // Nothing could be flown: tries from elsewhere, less carefully. A LiDAR that has turned makes a new key frame.
    flown_any_ = true;
    proof_.ask_less();
    idle(in.tick + ticks(kRestS), out);
    sortie_.pilot().retreat(in, out);
    out.yaw = wrap_angle(in.tracking.setpoint.yaw + kLookAroundTurn);
    return;
  }
  if (rounds_.over()) {
    rounds_.begin();
    flown_any_ = false;
    failures_ = 0;
  }
  if (rounds_.over()) {  // more UAVs than strips
    idle(in.tick + ticks(kRestS), out);
    return;
  }
  rounds_.take_next();
  strip_ = rounds_.strip();
  reversed_ = rounds_.reversed();
  strip_s_ = 0.0;
  approach(in, out);
}

/// Flies to the beginning of what can be flown of the current strip from strip_s_ on, or gives it up for this
/// round.
void PatrolPlanner::approach(const PlannerInput& in, PlannerOutput& out) {
  if (strip_s_ < strip_.length()) {
    const FreeSpace space = free_space(in);
    for (const Run& run : fit_strip(strip_, reversed_, strip_s_, {}, space, reach_, standoff_config())) {
      if (!sortie_.pilot().fly_to(run.waypoints.front().p_WB, in, space_config(), out)) continue;
      strip_s_ = run.first_s;
      phase_ = Phase::transit;
      face_strip(out);
      return;
    }
  }
  failures_ = 0;
  idle(in.tick, out);
}

void PatrolPlanner::fly_strip(const PlannerInput& in, PlannerOutput& out) {
  if (strip_s_ >= strip_.length()) {
    idle(in.tick, out);
    return;
  }
  const auto runs =
      fit_strip(strip_, reversed_, strip_s_, in.tracking.setpoint.p_WB, free_space(in), reach_, standoff_config());
  if (runs.empty()) {
    idle(in.tick, out);
    return;
  }
  if (runs.front().first_s > strip_s_) {  // the map has closed the beginning
    strip_s_ = runs.front().first_s;
    if (++failures_ > kMaxFailures) {
      idle(in.tick, out);
    } else {
      approach(in, out);
    }
    return;
  }
  flown_any_ = true;
  proof_.ask_all();
  failed_tasks_ = 0;
  if (task_ && !task_flown_) blocks_->flown(*task_);
  task_flown_ = true;
  phase_ = Phase::strip;
  refit_at_ = in.tick + ticks(kRefitS);
  run_length_ = runs.front().waypoints.size();
  sortie_.pilot().follow(Path{runs.front().waypoints}, in, out);
  face_strip(out);
}

/// The map may have grown: fits what is left of the strip again.
void PatrolPlanner::refit(const PlannerInput& in, PlannerOutput& out) {
  refit_at_ = in.tick + ticks(kRefitS);
  const double s = run_s(in.tracking.leg);
  if (s >= strip_.length()) return;
  const auto runs =
      fit_strip(strip_, reversed_, s, in.tracking.setpoint.p_WB, free_space(in), reach_, standoff_config());
  if (runs.empty() || runs.front().first_s > s) return;  // the safety stop will see to it
  strip_s_ = s;
  run_length_ = runs.front().waypoints.size();
  sortie_.pilot().follow(Path{runs.front().waypoints}, in, out);
}

void PatrolPlanner::face_strip(PlannerOutput& out) const {
  const double pitch_limit = agent_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg;
  if (strip_.kind == FaceKind::side) {
    out.yaw = std::atan2(-strip_.out_W.y(), -strip_.out_W.x());
    const int round = task_ ? task_->flown : std::max(0, rounds_.number());
    const double turn = kViewTurns[static_cast<std::size_t>(round) % std::size(kViewTurns)];
    out.gimbal = GimbalCommand{GimbalMode::angle, 0.0, turn};
    return;
  }
  // Along the strip and always the same way, so that the image's full width lies across it and nothing turns
  // in between.
  const Vector3d along = strip_.end_W - strip_.begin_W;
  out.yaw = std::atan2(along.y(), along.x());
  out.gimbal = GimbalCommand{GimbalMode::angle, strip_.kind == FaceKind::top ? pitch_limit : -pitch_limit, 0.0};
}

SKEIN_REGISTER_PLANNER("patrol", PatrolPlanner);

}  // namespace skein::agent
