// Flies along every face of every box in strips, at the distance where the camera is sharp. The planner uses only the
// boxes and the map, sends no messages, and serves as a baseline: it is simple, safe, and the same on every UAV.
//
// Each UAV flies its share of the strips (strips.hpp), closer to the real surface as the map grows (standoff.hpp), and
// then again with the camera turned to the side. An explorer and the photographers of its team work on the same part of
// the site (work_share.hpp): where the explorer has photographed, it has proved free space for them. In a loose box,
// which does not tell where the structure is, the strips come from the map (block_work.hpp). The flight core does the
// flying (flight_core/flight_core.hpp).
#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/planners/patrol/config.hpp"
#include "uav_agent/planning/block_work.hpp"
#include "uav_agent/planning/own_strips.hpp"
#include "uav_agent/planning/standoff.hpp"
#include "uav_agent/planning/work_share.hpp"

namespace skein::agent {
namespace {

constexpr double kRefitS = 2.0;  ///< time between two refits of the current strip; chosen
constexpr double kRestS = 3.0;   ///< wait when no strip can be flown; chosen
/// Yaw of the gimbal in successive flights along a strip [rad]. Chosen.
constexpr double kViewTurns[] = {0.0, 0.45, -0.45};
constexpr int kMaxFailures = 3;        ///< failures in one flight along a strip; the next one ends this flight; chosen
constexpr double kStartHeight = 0.25;  ///< assumed height at which tours begin, as a share of the site's height; chosen
constexpr int kMostTries = 3;          ///< most strips that are fitted in one exchange; chosen

}  // namespace

class PatrolPlanner final : public Planner {
 public:
  using Config = PatrolConfig;

  PatrolPlanner(const Config& config, const AgentConfig& agent)
      : config_(config), agent_(agent), reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)) {}

  const FlightConfig* flight() const override { return &config_.flight; }
  PlannerOutput plan(const PlannerInput& in) override;

 private:
  StandoffConfig standoff_config() const;
  void share_work(const PlannerInput& in);
  void handle_outcome(const Outcome& outcome, const PlannerInput& in);
  std::vector<Goal> next_goals(const PlannerInput& in);
  bool take_strip(const PlannerInput& in);
  std::vector<Goal> strip_goals(const PlannerInput& in, const std::optional<Vector3d>& p_W_now);
  std::vector<Goal> refitted(const PlannerInput& in);
  void mark_flown();
  void face_strip(Goal& goal) const;
  void give_up_strip(const PlannerInput& in);
  /// Distance along the strip of the waypoint `leg` of the current stretch (Run).
  double run_s(std::size_t leg) const { return strip_s_ + standoff_config().step_m * static_cast<double>(leg); }

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;

  bool shared_ = false;  ///< the boxes have arrived, and the work is shared
  OwnStrips strips_;
  std::optional<BlockWork> blocks_;
  std::optional<std::size_t> own_;       ///< number of the current strip, if it comes from strips_
  std::optional<BlockWork::Task> task_;  ///< task of the current strip, if it comes from blocks_
  int times_flown_ = 0;                  ///< how often this UAV has flown the current strip before
  bool flown_ = false;                   ///< the UAV has flown a part of the current strip this time
  std::optional<Strip> strip_;           ///< the current strip
  bool reversed_ = false;                ///< the strip is flown from its end to its beginning
  double strip_s_ = 0.0;                 ///< where on the strip the current stretch begins [m]
  std::size_t run_length_ = 0;           ///< number of waypoints of the current stretch
  int failures_ = 0;                     ///< failures in this flight along the current strip
  std::int64_t id_ = 0;                  ///< id of the current goal
  bool flying_ = false;                  ///< the UAV flies to the strip or along it
  Tick refit_at_ = 0, rest_until_ = 0;
};

PlannerOutput PatrolPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !shared_) share_work(in);
  if (!in.flight.working || !shared_) return out;
  for (const Outcome& outcome : in.flight.outcomes) {
    if (outcome.id == id_) handle_outcome(outcome, in);
  }
  if (!flying_ && in.tick >= rest_until_) {
    out.goals = next_goals(in);
    flying_ = !out.goals->empty();
    ++id_;
  } else if (flying_ && strip_ && in.flight.on_way && in.tick >= refit_at_) {
    refit_at_ = in.tick + ticks(kRefitS);
    mark_flown();
    if (auto goals = refitted(in); !goals.empty()) out.goals = std::move(goals);
  }
  if (out.goals && flying_) out.goals->front().id = id_;
  return out;
}

/// Fits the rest of the strip again, because the map may have grown. Empty: the current goal stays.
std::vector<Goal> PatrolPlanner::refitted(const PlannerInput& in) {
  const double s = run_s(in.flight.leg), before_s = strip_s_;
  const std::size_t before_length = run_length_;
  strip_s_ = s;
  std::vector<Goal> goals = strip_goals(in, in.tracking.setpoint.p_WB);
  if (!goals.empty() && strip_s_ <= s) return goals;
  strip_s_ = before_s;
  run_length_ = before_length;
  return {};
}

void PatrolPlanner::mark_flown() {
  if (flown_) return;
  flown_ = true;
  if (task_) blocks_->flown(*task_);
  if (own_) strips_.flown(*own_);
}

StandoffConfig PatrolPlanner::standoff_config() const {
  StandoffConfig config;
  config.ratio = config_.standoff_ratio;
  config.blind_ratio = config_.blind_ratio;
  config.speed_gain = config_.speed_gain;
  config.max_speed_mps = config_.flight.approach_mps;
  return config;
}

void PatrolPlanner::share_work(const PlannerInput& in) {
  shared_ = true;
  const bool blind = !agent_.first_explorer();  // without a LiDAR, the map never shows the structure
  WorkShareConfig config;
  config.strips.standoff_ratio = config_.standoff_ratio;
  config.strips.overlap = config_.overlap;
  config.strips.top = config_.top;
  config.strips.bottom = config_.bottom;
  config.standoff = standoff_config();
  config.transit_mps = config_.flight.approach_mps;
  const BlockWork::Config blocks{.strips = config.strips, .transit_mps = config_.flight.approach_mps};
  blocks_.emplace(blocks, agent_, reach_, blind ? std::vector<OrientedBox>() : in.boxes);
  std::vector<OrientedBox> tight = in.boxes;
  if (!blind) std::erase_if(tight, is_site_box);
  strips_ = OwnStrips(team_share(agent_, tight, reach_, kStartHeight * top_of(in.boxes), config));
}

void PatrolPlanner::handle_outcome(const Outcome& outcome, const PlannerInput& in) {
  flying_ = false;
  if (outcome.kind == Outcome::Kind::reached) {
    strip_s_ = run_s(run_length_);
    mark_flown();
    return;
  }
  if (outcome.kind == Outcome::Kind::blocked) strip_s_ = run_s(outcome.leg);
  if (outcome.kind == Outcome::Kind::no_way || ++failures_ > kMaxFailures) give_up_strip(in);
}

/// Leaves the current strip; if none of it was flown, it counts as failed.
void PatrolPlanner::give_up_strip(const PlannerInput& in) {
  if (!flown_ && task_) blocks_->failed(*task_, in.tick);
  if (!flown_ && own_) strips_.failed(*own_, in.tick);
  strip_.reset();
  failures_ = 0;
}

/// A goal for the next stretch of a strip; empty: none was found in this exchange.
std::vector<Goal> PatrolPlanner::next_goals(const PlannerInput& in) {
  for (int tries = 0; tries < kMostTries; ++tries) {
    if (!strip_ && !take_strip(in)) {
      rest_until_ = std::max(rest_until_, in.tick + ticks(kRestS));
      return {};
    }
    if (auto goals = strip_goals(in, std::nullopt); !goals.empty()) return goals;
    give_up_strip(in);
  }
  return {};
}

/// Chooses the next strip: one that this UAV has flown least often. @returns whether there is one.
bool PatrolPlanner::take_strip(const PlannerInput& in) {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  task_ = blocks_->any() ? blocks_->next(in.tick, here_W, in.map) : std::nullopt;
  own_ = strips_.next(in.tick, here_W);
  if (!task_ && !own_) return false;
  if (own_ && task_ && task_->flown < strips_.times_flown(*own_)) own_.reset();
  if (own_) task_.reset();
  strip_ = own_ ? strips_.strip(*own_) : task_->strip;
  reversed_ = own_ ? strips_.begins_at_end(*own_, here_W) : task_->reversed;
  times_flown_ = own_ ? strips_.times_flown(*own_) : task_->flown;
  flown_ = false;
  strip_s_ = 0.0;
  return true;
}

/// A goal for the first stretch of the current strip that can be flown from strip_s_ on; empty: there is none.
std::vector<Goal> PatrolPlanner::strip_goals(const PlannerInput& in, const std::optional<Vector3d>& p_W_now) {
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

void PatrolPlanner::face_strip(Goal& goal) const {
  const double pitch_limit = agent_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg;
  if (strip_->kind == FaceKind::side) {
    goal.yaw = std::atan2(-strip_->out_W.y(), -strip_->out_W.x());
    const double turn = kViewTurns[static_cast<std::size_t>(times_flown_) % std::size(kViewTurns)];
    goal.gimbal = GimbalCommand{GimbalMode::angle, 0.0, turn};
    return;
  }
  // Top and bottom: the body faces along the strip, in the same direction whether the UAV flies the strip forwards or
  // backwards. So the image's full width lies across the strip, and the UAV does not turn around between two strips.
  const Vector3d along = strip_->end_W - strip_->begin_W;
  goal.yaw = std::atan2(along.y(), along.x());
  goal.gimbal = GimbalCommand{GimbalMode::angle, strip_->kind == FaceKind::top ? pitch_limit : -pitch_limit, 0.0};
}

SKEIN_REGISTER_PLANNER("patrol", PatrolPlanner);

}  // namespace skein::agent
