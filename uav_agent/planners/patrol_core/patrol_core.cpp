// `patrol` on the new flight core, beside it until all strategies fly on that (docs/decisions/0029-flight-core.md):
// flies along every face of every box in strips, at the distance where the camera is sharp. It knows the boxes and its
// own map, talks to nobody, and is meant as an honest baseline: simple, safe, the same on every UAV.
//
// In turn: explorers fly once around everything; then each UAV flies its share of the strips (strips.hpp), closing in
// on the real surface as the map fills (standoff.hpp), and begins its share again with the camera turned a little. In a
// box that is too large to say where the structure is, the strips come from the map (block_work.hpp). The flight core
// does the flying (flight_core/flight_core.hpp).
#include <algorithm>
#include <cmath>

#include "core/euler.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/planners/patrol/rounds.hpp"
#include "uav_agent/planners/patrol_core/config.hpp"
#include "uav_agent/planning/block_work.hpp"
#include "uav_agent/planning/standoff.hpp"
#include "uav_agent/planning/survey.hpp"
#include "uav_agent/planning/work_share.hpp"

namespace skein::agent {
namespace {

constexpr double kRefitS = 2.0;                      ///< between two looks at the map while on a strip
constexpr double kRestS = 3.0;                       ///< after a round in which no strip could be flown
constexpr double kViewTurns[] = {0.0, 0.45, -0.45};  ///< of the camera to the side, by round [rad]
constexpr int kMaxFailures = 3;                      ///< of a strip, in a round
constexpr double kAboveGroundM = 4.0;                ///< at least, of the survey's ring

}  // namespace

class PatrolCorePlanner final : public Planner {
 public:
  using Config = PatrolCoreConfig;

  PatrolCorePlanner(const Config& config, const AgentConfig& agent)
      : config_(config), agent_(agent), reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)) {}

  const FlightConfig* flight() const override { return &config_.flight; }
  PlannerOutput plan(const PlannerInput& in) override;

 private:
  StandoffConfig standoff_config() const;
  void share_work(const PlannerInput& in);
  void take_note(const Outcome& outcome);
  std::vector<Goal> next_goals(const PlannerInput& in);
  bool take_strip(const PlannerInput& in);
  bool take_block(const PlannerInput& in);
  std::vector<Goal> strip_goals(const PlannerInput& in, const std::optional<Vector3d>& p_W_now);
  std::vector<Goal> refitted(const PlannerInput& in);
  void strip_is_flown();
  void face_strip(Goal& goal) const;
  void give_strip_up();
  /// Where on the strip the waypoint `leg` of the present run is.
  double run_s(std::size_t leg) const { return strip_s_ + standoff_config().step_m * static_cast<double>(leg); }

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;

  bool shared_ = false;         ///< the boxes have come
  std::vector<Vector3d> ring_;  ///< of the survey, what is left of it
  PatrolRounds rounds_;
  bool flown_any_ = true;  ///< in this round
  std::optional<BlockWork> blocks_;
  std::optional<BlockWork::Task> task_;  ///< of blocks_; else the current strip is of the rounds
  bool task_flown_ = false;
  std::optional<Strip> strip_;  ///< the current one; none: the survey, or nothing
  bool reversed_ = false;       ///< its direction
  double strip_s_ = 0.0;        ///< where on the strip the present run begins
  std::size_t run_length_ = 0;  ///< waypoints of it
  int failures_ = 0;            ///< of this strip
  std::int64_t id_ = 0;         ///< of the current goal
  bool flying_ = false;         ///< to it, or along it
  Tick refit_at_ = 0, rest_until_ = 0;
};

PlannerOutput PatrolCorePlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !shared_) share_work(in);
  if (!in.flight.working || !shared_) return out;
  for (const Outcome& outcome : in.flight.outcomes) {
    if (outcome.id == id_) take_note(outcome);
  }
  if (!flying_ && in.tick >= rest_until_) {
    out.goals = next_goals(in);
    flying_ = !out.goals->empty();
    ++id_;
  } else if (flying_ && strip_ && in.flight.on_way && in.tick >= refit_at_) {
    refit_at_ = in.tick + ticks(kRefitS);
    strip_is_flown();
    if (auto goals = refitted(in); !goals.empty()) out.goals = std::move(goals);
  }
  if (out.goals && flying_) out.goals->front().id = id_;
  return out;
}

/// The map may have grown: fits what is left of the strip again. Empty: as it was.
std::vector<Goal> PatrolCorePlanner::refitted(const PlannerInput& in) {
  const double s = run_s(in.flight.leg), before_s = strip_s_;
  const std::size_t before_length = run_length_;
  strip_s_ = s;
  std::vector<Goal> goals = strip_goals(in, in.tracking.setpoint.p_WB);
  if (!goals.empty() && strip_s_ <= s) return goals;
  strip_s_ = before_s;
  run_length_ = before_length;
  return {};
}

void PatrolCorePlanner::strip_is_flown() {
  flown_any_ = true;
  if (task_ && !task_flown_) blocks_->flown(*task_);
  task_flown_ = true;
}

StandoffConfig PatrolCorePlanner::standoff_config() const {
  StandoffConfig config;
  config.ratio = config_.standoff_ratio;
  config.blind_ratio = config_.blind_ratio;
  config.speed_gain = config_.speed_gain;
  config.max_speed_mps = config_.flight.approach_mps;
  return config;
}

void PatrolCorePlanner::share_work(const PlannerInput& in) {
  shared_ = true;
  const double top_m = top_of(in.boxes);
  const bool blind = !agent_.first_explorer();
  WorkShareConfig config;
  config.strips.standoff_ratio = config_.standoff_ratio;
  config.strips.overlap = config_.overlap;
  config.strips.top = config_.top;
  config.strips.bottom = config_.bottom;
  config.standoff = standoff_config();
  config.transit_mps = config_.flight.approach_mps;
  config.survey = config_.survey;
  config.survey_standoff_m = config_.survey_standoff_m;
  config.survey_mps = config_.survey_mps;
  const BlockWork::Config blocks{.strips = config.strips, .transit_mps = config_.flight.approach_mps};
  blocks_.emplace(blocks, agent_, reach_, blind ? std::vector<OrientedBox>() : in.boxes);
  std::vector<OrientedBox> tight = in.boxes;
  if (!blind) std::erase_if(tight, is_roomy);
  rounds_.know_share(own_share(agent_, tight, reach_, 0.5 * top_m, config));
  if (config_.survey) {
    ring_ = survey_ring(agent_, in.boxes, config_.survey_standoff_m, std::max(kAboveGroundM, 0.5 * top_m));
  }
}

void PatrolCorePlanner::take_note(const Outcome& outcome) {
  flying_ = false;
  if (!strip_) {  // of the survey: goes on behind what it did not get to
    const std::size_t passed = outcome.kind == Outcome::Kind::reached ? ring_.size() : outcome.leg + 1;
    ring_.erase(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(std::min(passed, ring_.size())));
    return;
  }
  if (outcome.kind == Outcome::Kind::reached) {
    strip_s_ = run_s(run_length_);
    strip_is_flown();
    return;
  }
  if (outcome.kind == Outcome::Kind::blocked) strip_s_ = run_s(outcome.leg);
  if (outcome.kind == Outcome::Kind::no_way || ++failures_ > kMaxFailures) give_strip_up();
}

/// Nothing more of it in this round.
void PatrolCorePlanner::give_strip_up() {
  strip_.reset();
  failures_ = 0;
}

/// At most one.
std::vector<Goal> PatrolCorePlanner::next_goals(const PlannerInput& in) {
  if (!ring_.empty()) return {Goal{.way = path_through(ring_, config_.survey_mps).waypoints}};
  for (int tries = 0; tries < kMaxFailures; ++tries) {
    if (!strip_ && !take_strip(in)) {
      rest_until_ = std::max(rest_until_, in.tick + ticks(kRestS));
      return {};
    }
    if (auto goals = strip_goals(in, std::nullopt); !goals.empty()) return goals;
    if (task_ && !task_flown_) blocks_->failed(*task_, in.tick);
    give_strip_up();
  }
  return {};
}

/// What to fly next. @returns false if there is nothing.
bool PatrolCorePlanner::take_strip(const PlannerInput& in) {
  const bool shares_done = rounds_.over() && (rounds_.number() >= 0 || rounds_.without_work());
  if (blocks_->any() && shares_done && take_block(in)) return strip_.has_value();
  task_.reset();
  if (rounds_.over() && !flown_any_ && !rounds_.without_work()) {  // nothing could be flown: the core recovers
    flown_any_ = true;
    return false;
  }
  if (rounds_.over()) {
    rounds_.begin();
    flown_any_ = false;
  }
  if (rounds_.over()) return false;  // more UAVs than strips
  rounds_.take_next();
  strip_ = rounds_.strip();
  reversed_ = rounds_.reversed();
  strip_s_ = 0.0;
  return true;
}

/// Takes up a strip in a block, or waits for the map to show one. @returns false if there is other work.
bool PatrolCorePlanner::take_block(const PlannerInput& in) {
  task_ = blocks_->next(in.tick, in.tracking.setpoint.p_WB, in.map);
  const bool again = task_ && task_->flown > rounds_.number();
  if (!rounds_.without_work() && (!task_ || again)) return false;
  if (!task_) return true;
  task_flown_ = false;
  strip_ = task_->strip;
  reversed_ = task_->reversed;
  strip_s_ = 0.0;
  return true;
}

/// The first stretch of what is left of the current strip, from strip_s_ on: a goal, or none.
std::vector<Goal> PatrolCorePlanner::strip_goals(const PlannerInput& in, const std::optional<Vector3d>& p_W_now) {
  std::vector<Goal> goals;
  if (strip_s_ >= strip_->length()) return goals;
  auto runs = fit_strip(*strip_, reversed_, strip_s_, p_W_now, *in.space, reach_, standoff_config());
  if (runs.empty()) return goals;
  strip_s_ = runs.front().first_s;
  run_length_ = runs.front().waypoints.size();
  if (!p_W_now) refit_at_ = 0;
  goals.emplace_back().way = std::move(runs.front().waypoints);
  face_strip(goals.back());
  return goals;
}

void PatrolCorePlanner::face_strip(Goal& goal) const {
  const double pitch_limit = agent_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg;
  if (strip_->kind == FaceKind::side) {
    goal.yaw = std::atan2(-strip_->out_W.y(), -strip_->out_W.x());
    const int round = task_ ? task_->flown : std::max(0, rounds_.number());
    const double turn = kViewTurns[static_cast<std::size_t>(round) % std::size(kViewTurns)];
    goal.gimbal = GimbalCommand{GimbalMode::angle, 0.0, turn};
    return;
  }
  // Along the strip and always the same way, so that the image's full width lies across it and nothing turns
  // in between.
  const Vector3d along = strip_->end_W - strip_->begin_W;
  goal.yaw = std::atan2(along.y(), along.x());
  goal.gimbal = GimbalCommand{GimbalMode::angle, strip_->kind == FaceKind::top ? pitch_limit : -pitch_limit, 0.0};
}

SKEIN_REGISTER_PLANNER("patrol_core", PatrolCorePlanner);

}  // namespace skein::agent
