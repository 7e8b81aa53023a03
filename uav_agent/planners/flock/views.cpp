#include "uav_agent/planners/flock/views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/math/euler.hpp"
#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {
namespace {

constexpr double kTilt = 0.6;              ///< angle of tilted views to the target's normal [rad]; chosen
constexpr double kPlaceM = 2.0;            ///< edge of the cells in which votes for places add up; chosen
constexpr double kPieceM = 4.0;            ///< edge of the pieces of surface that vote as one; chosen
constexpr int kDirections = 3;             ///< cells of directions along each axis; geometry: -1, 0, 1
constexpr double kNearAxis = 1.3;          ///< a component of at least 0.5 / 1.3 counts as along its axis; chosen
constexpr double kLeastOpen = 0.04;        ///< targets with less to gain do not vote [points]; chosen
constexpr double kWayM = 20.0;             ///< a view's votes are divided by its distance plus this; chosen
constexpr double kLeastQuality = 0.2;      ///< worse pictures are not counted; formula: RulesConfig::min_point_score
constexpr double kLeastSight = 0.01;       ///< a view does not show targets of which it gains less [points]; chosen
constexpr double kLeastClaimM = 0.1;       ///< a claim with a nearer aim has no direction: it is damaged; chosen
constexpr double kGlanceTurn = 0.8;        ///< glances: most turn of the camera [rad]; chosen
constexpr double kGlanceFacing = 0.35;     ///< ... least cosine between line of sight and normal; chosen
constexpr double kGlanceRatio = 1.3;       ///< ... most distance, in distances of a far view; chosen
constexpr double kGlanceNearM = 1.0;       ///< ... least distance; chosen
constexpr double kGlanceYawSpare = 0.3;    ///< ... least angle to the gimbal's yaw limit [rad]; chosen
constexpr double kLeastGlance = 0.3;       ///< glances with less gain are left out [points]; chosen
constexpr std::size_t kMostAims = 5;       ///< most aims evaluated for a glance; chosen: bounds the CPU time
constexpr std::size_t kMostLookouts = 20;  ///< chosen: bounds the CPU time
constexpr std::size_t kMostGaps = 40;      ///< most gaps for which places are proposed; chosen: bounds the CPU time
constexpr double kSurveyShare = 0.7;       ///< surveyed_m() in units of survey_m; chosen
constexpr double kGapM = 10.0;             ///< distance from a gap to the places proposed for it; chosen
constexpr int kGapSides = 8;               ///< places proposed around a gap; chosen
/// Expected surface in a survey cell, before any was found. Chosen: one side of the cell.
constexpr double kCellSurfaceM2 = FlockSurvey::kCellM * FlockSurvey::kCellM;
constexpr double kPriorCells = 20.0;  ///< cells with this surface that the estimate begins with; chosen

struct Direction {
  double yaw = 0.0, pitch = 0.0;  ///< pitch down
};

Direction direction_of(const Vector3d& way) {
  return {std::atan2(way.y(), way.x()), std::atan2(-way.z(), way.head<2>().norm())};
}

/// Rounds halves away from zero, as round() does, but without the function calls.
Eigen::Vector3i rounded(const Vector3d& v) {
  const Eigen::Vector3i whole = v.cast<int>();
  const Vector3d rest = v - whole.cast<double>();
  return whole.array() + (rest.array() >= 0.5).cast<int>() - (rest.array() <= -0.5).cast<int>();
}

/// Rounds a unit vector to one of 26 directions, as a cell of 3 x 3 x 3.
Eigen::Vector3i direction_cell(const Vector3d& direction_W) {
  return rounded(kNearAxis * direction_W) + Eigen::Vector3i::Ones();
}

bool proved(const FreeSpace& space, const Vector3d& p_W) {
  return space.config().blind_fleet || space.cost(p_W) <= 1.0;
}

}  // namespace

FlockTargets::FlockTargets(std::vector<FlockTarget> targets, double range_m)
    : targets_(std::move(targets)), cell_m_(range_m) {
  Eigen::AlignedBox3d extent;
  for (const FlockTarget& target : targets_) extent.extend(target.p_W);
  if (targets_.empty()) extent.extend(Vector3d::Zero());
  low_W_ = extent.min();
  dims_ = (extent.sizes() / cell_m_).array().floor().cast<int>() + 1;
  const auto cell_of = [&](const Vector3d& p_W) {
    const Eigen::Vector3i at = ((p_W - low_W_) / cell_m_).array().floor().cast<int>().min(dims_.array() - 1);
    return static_cast<std::size_t>((at.z() * dims_.y() + at.y()) * dims_.x() + at.x());
  };
  begins_.assign(static_cast<std::size_t>(dims_.prod()) + 1, 0);
  for (const FlockTarget& target : targets_) ++begins_[cell_of(target.p_W) + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  order_.resize(targets_.size());
  for (std::uint32_t i = 0; i < targets_.size(); ++i) order_[next[cell_of(targets_[i].p_W)]++] = i;
}

Exposure exposure_of(const FlockView& view, const AgentConfig& agent) {
  const Direction direction = direction_of(view.aim_W - view.p_WB);
  RigidBodyState body;
  body.p_WB = view.p_WB;
  body.q_WB = Eigen::AngleAxisd(direction.yaw, Vector3d::UnitZ());
  const CameraState camera = camera_state(body, {direction.pitch, 0.0, 0.0, 0.0}, agent.vehicle.camera);
  return {camera, agent.vehicle.camera, agent.desired_mm_per_pixel, ResolutionRule::contest};
}

struct FlockViews::Vote {
  Vector3d p_sum_W = Vector3d::Zero(), aim_sum_W = Vector3d::Zero();
  double weight = 0.0;
};

double FlockViews::range_m() const { return FlockSurfaces::kPictureRatio * sharp_m_; }

double FlockViews::surveyed_m() const { return kSurveyShare * config_.survey_m; }

/// The voters: surface that no camera has looked at, in pieces, and single points.
std::vector<FlockTarget> FlockViews::voters(const FlockTargets& targets) const {
  std::vector<FlockTarget> voters;
  BlockTable<std::uint32_t> piece_of;  // by place and direction: index of the piece + 1
  for (const FlockTarget& target : targets.all()) {
    if (target.open() < kLeastOpen) continue;
    if (target.known) {
      voters.push_back(target);
      continue;
    }
    const Eigen::Vector3i place = (target.p_W / kPieceM).array().floor().cast<int>();
    std::uint32_t& piece = piece_of[grid_key(kDirections * place + direction_cell(target.n_W))];
    if (piece == 0) {
      voters.push_back({.p_W = Vector3d::Zero(), .n_W = target.n_W, .points = 0.0});
      piece = static_cast<std::uint32_t>(voters.size());
    }
    FlockTarget& sum = voters[piece - 1];
    sum.p_W = (sum.p_W * sum.points + target.p_W * target.open()) / (sum.points + target.open());
    sum.points += target.open();
  }
  return voters;
}

namespace {

/// A direction from a target to a camera.
struct Side {
  Vector3d out_W = Vector3d::UnitX();
  Eigen::Vector3i cell = Eigen::Vector3i::Zero();  ///< direction_cell()
  bool in_reach = true;                            ///< the gimbal can point the camera back along it
};

constexpr std::size_t kSides = 5;  ///< geometry: straight before the target, and tilted to four sides

/// @param steepest  sine of the camera's greatest pitch.
std::array<Side, kSides> sides_of(const Vector3d& n_W, double steepest) {
  const Vector3d u = n_W.unitOrthogonal(), v = n_W.cross(u);
  const double tilt = std::tan(kTilt);
  const auto tilted = [&](const Vector3d& aside_W) { return Vector3d((n_W + tilt * aside_W).normalized()); };
  std::array<Side, kSides> sides;
  const std::array<Vector3d, kSides> out_W = {n_W, tilted(u), tilted(-u), tilted(v), tilted(-v)};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    sides[i] = {out_W[i], direction_cell(out_W[i]), !(std::abs(out_W[i].z()) > steepest)};
  }
  return sides;
}

}  // namespace

std::vector<FlockViews::Vote> FlockViews::votes(const FlockTargets& targets) const {
  const double steepest = std::sin(agent_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg);
  std::vector<Vote> votes;
  BlockTable<std::uint32_t> number_of;  // by place and direction: index of the vote + 1
  const auto vote = [&](const FlockTarget& target, const Side& side, double distance_m, double worth) {
    const Vector3d p_W = target.p_W + distance_m * side.out_W;
    if (p_W.z() < config_.flight.floor_m) return;
    std::uint32_t& number = number_of[grid_key(kDirections * rounded(p_W / kPlaceM) + side.cell)];
    if (number == 0) {
      votes.emplace_back();
      number = static_cast<std::uint32_t>(votes.size());
    }
    Vote& votes_here = votes[number - 1];
    votes_here.p_sum_W += worth * p_W;
    votes_here.aim_sum_W += worth * target.p_W;
    votes_here.weight += worth;
  };
  const double cosine = std::cos(kTilt);
  for (const FlockTarget& target : voters(targets)) {
    const std::array<Side, kSides> sides = sides_of(target.n_W, steepest);
    for (const double ratio : {config_.wide_ratio, config_.far_ratio, config_.near_ratio}) {
      const double far_m = ratio * sharp_m_;
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const double part = i == 0 ? 1.0 : cosine;
        if (sides[i].in_reach) vote(target, sides[i], part * far_m, part * target.open());
      }
    }
  }
  return votes;
}

std::vector<FlockView> FlockViews::find(const FlockSurfaces& surfaces, const FlockTargets& targets,
                                        const FreeSpace& space, const Vector3d& p_W, bool explores) const {
  const std::vector<Vote> places = votes(targets);
  std::vector<std::pair<double, std::size_t>> promising;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double way_m = (places[i].p_sum_W / places[i].weight - p_W).norm();
    promising.emplace_back(-places[i].weight / (kWayM + way_m), i);
  }
  std::ranges::make_heap(promising, std::greater<>());  // only the best of thousands are needed, in order
  std::vector<FlockView> views;
  const std::size_t most = static_cast<std::size_t>(config_.max_views);
  std::size_t unproved = 0;
  while (!promising.empty() && views.size() < most) {
    std::ranges::pop_heap(promising, std::greater<>());
    const Vote& vote = places[promising.back().second];
    promising.pop_back();
    FlockView view{.p_WB = vote.p_sum_W / vote.weight, .aim_W = vote.aim_sum_W / vote.weight};
    if (!space.free(view.p_WB)) continue;
    view.proved = proved(space, view.p_WB);
    if (!view.proved && (!explores || unproved >= most / 2 || !surfaces.survey().seen(view.p_WB))) continue;
    judge(surfaces, targets, view);
    if (view.sights.empty()) continue;
    if (!view.proved) ++unproved;
    views.push_back(std::move(view));
  }
  return views;
}

std::vector<FlockView> FlockViews::lookouts(const FlockSurfaces& surfaces, const FlockTargets& targets,
                                            const FreeSpace& space, const Vector3d& p_W) const {
  const double steepest = std::sin(agent_.vehicle.gimbal.pitch_limit_deg * kRadPerDeg);
  std::vector<FlockView> places;
  for (const FlockTarget& target : targets.all()) {
    if (std::abs(target.n_W.z()) > steepest) continue;
    places.push_back({.p_WB = target.p_W + config_.wide_ratio * sharp_m_ * target.n_W, .aim_W = target.p_W});
  }
  std::ranges::stable_sort(places, std::less<>(), [&](const FlockView& view) { return (view.p_WB - p_W).norm(); });
  std::vector<FlockView> views;
  for (FlockView& view : places) {
    if (views.size() == kMostLookouts) break;
    if (view.p_WB.z() < config_.flight.floor_m || !space.free(view.p_WB) || !proved(space, view.p_WB)) continue;
    judge(surfaces, targets, view);
    if (!view.sights.empty()) views.push_back(std::move(view));
  }
  return views;
}

void FlockViews::judge(const FlockSurfaces& surfaces, const FlockTargets& targets, FlockView& view) const {
  const Exposure exposure = exposure_of(view, agent_);
  view.sights.clear();
  targets.near(exposure.position(), [&](std::uint32_t i) {
    const FlockTarget& target = targets.all()[i];
    const Vector3d to_camera = exposure.position() - target.p_W;
    if (to_camera.dot(target.n_W) <= 0.0) return;
    const auto p_C = exposure.view(target.p_W);
    if (!p_C) return;
    const auto score = exposure.score(*p_C, target.n_W);
    if (!score || score->q_res < kLeastQuality || target.points * (score->q_res - target.have) < kLeastSight) return;
    if (surfaces.sees(exposure.position(), target.p_W)) view.sights.push_back({i, static_cast<float>(score->q_res)});
  });
}

std::vector<Vector3d> FlockViews::aims(const FlockTargets& targets, const Vector3d& p_WB, const RigidBodyState& state,
                                       const GimbalState& gimbal) const {
  struct Piece {
    Vector3d sum_W = Vector3d::Zero();
    double open = 0.0;
  };
  const Vector3d axis_W = camera_state(state, gimbal, agent_.vehicle.camera).X_WC.linear().col(0);
  const double yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw;
  const Vector3d ahead_W(std::cos(yaw), std::sin(yaw), 0.0);
  const double yaw_limit = std::cos(agent_.vehicle.gimbal.yaw_limit_deg * kRadPerDeg - kGlanceYawSpare);
  const double far_m = config_.far_ratio * sharp_m_;
  std::map<std::array<int, 3>, Piece> pieces;
  targets.near(p_WB, [&](std::uint32_t i) {
    const FlockTarget& target = targets.all()[i];
    const Vector3d way = target.p_W - p_WB;
    const double length = way.norm();
    if (length > kGlanceRatio * far_m || length < kGlanceNearM || -way.dot(target.n_W) < kGlanceFacing * length) return;
    const double turn = std::acos(std::clamp(way.dot(axis_W) / length, -1.0, 1.0));
    if (turn > kGlanceTurn || way.dot(ahead_W) < yaw_limit * way.head<2>().norm()) return;
    const Eigen::Vector3i place = (target.p_W / kPieceM).array().floor().cast<int>();
    Piece& piece = pieces[{place.x(), place.y(), place.z()}];
    piece.sum_W += target.open() * target.p_W;
    piece.open += target.open();
  });
  std::vector<std::pair<double, Vector3d>> best;
  for (const auto& [place, piece] : pieces) {
    if (piece.open > 0.0) best.emplace_back(piece.open, piece.sum_W / piece.open);
  }
  std::ranges::stable_sort(best, std::greater<>(), [](const auto& entry) { return entry.first; });
  std::vector<Vector3d> aims;
  for (const auto& [open, p_W] : best) {
    if (aims.size() < kMostAims) aims.push_back(p_W);
  }
  return aims;
}

std::optional<FlockView> FlockViews::glance(const FlockSurfaces& surfaces, const FlockTargets& targets,
                                            const Vector3d& p_WB, const RigidBodyState& state,
                                            const GimbalState& gimbal) const {
  std::optional<FlockView> best;
  double most = kLeastGlance;
  for (const Vector3d& aim_W : aims(targets, p_WB, state, gimbal)) {
    FlockView view{.p_WB = p_WB, .aim_W = aim_W};
    judge(surfaces, targets, view);
    double gain = 0.0;
    for (const FlockView::Sight& sight : view.sights) {
      const FlockTarget& target = targets.all()[sight.target];
      gain += target.points * std::max(0.0, sight.q - target.have);
    }
    if (gain <= most) continue;
    most = gain;
    best = std::move(view);
  }
  return best;
}

void FlockViews::count_claims(const FlockSurfaces& surfaces, const std::vector<FlockClaim>& claims,
                              FlockTargets& targets) const {
  for (const FlockClaim& claim : claims) {
    FlockView view{.p_WB = claim.p_WB, .aim_W = claim.aim_W};
    if (!((view.aim_W - view.p_WB).norm() > kLeastClaimM)) continue;
    judge(surfaces, targets, view);
    for (const FlockView::Sight& sight : view.sights) {
      FlockTarget& target = targets.all()[sight.target];
      target.have = std::max(target.have, kClaimedShare * sight.q);
    }
  }
}

void FlockViews::find_gaps(const FlockSurfaces& surfaces, const FreeSpace& space, const Vector3d& p_W, double lack,
                           std::vector<FlockView>& views) const {
  if (lack <= 0.0) return;
  const FlockSurvey& survey = surfaces.survey();
  const double cell_m2 =
      (surfaces.surface_m2() + kPriorCells * kCellSurfaceM2) / (static_cast<double>(survey.surveyed()) + kPriorCells);
  const double points = lack * surfaces.density() * cell_m2;
  std::vector<FlockGap> gaps = survey.gaps();
  std::ranges::stable_sort(gaps, std::greater<>(),
                           [&](const FlockGap& gap) { return gap.cells / (kWayM + (gap.middle_W - p_W).norm()); });
  if (gaps.size() > kMostGaps) gaps.resize(kMostGaps);
  for (const FlockGap& gap : gaps) {
    std::optional<Vector3d> best_W;
    for (int i = 0; i < kGapSides; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kGapSides;
      Vector3d place = gap.middle_W + kGapM * Vector3d(std::cos(turn), std::sin(turn), 0.0);
      place.z() = std::max(place.z(), config_.flight.floor_m + 1.0);
      if (best_W && (*best_W - p_W).norm() <= (place - p_W).norm()) continue;
      if (space.free(place) && surfaces.sees(place, gap.middle_W)) best_W = place;
    }
    if (!best_W) continue;
    FlockView view{.p_WB = *best_W, .aim_W = gap.middle_W};
    view.proved = space.cost(*best_W) <= 1.0;
    for (const FlockGap& other : gaps) {
      if ((other.middle_W - *best_W).norm() < surveyed_m() && surfaces.sees(*best_W, other.middle_W)) {
        view.survey += points * other.cells;
      }
    }
    views.push_back(std::move(view));
  }
}

}  // namespace skein::agent
