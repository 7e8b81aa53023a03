#include "uav_agent/planners/flock/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kAutoVoxelRatio = 0.2;                        ///< edge of a cube by the camera, in units of d*; chosen
constexpr double kSmallestVoxelM = 1.0, kLargestVoxelM = 2.0;  ///< limits of this edge; chosen
constexpr double kFreeAroundM = 0.5;    ///< radius around a cube's middle that must be free; chosen
constexpr double kLowestM = 0.3;        ///< surface below this height does not count; chosen
constexpr double kEndCubes = 1.2;       ///< last part of a line of sight that belongs to the surface; chosen
constexpr double kPriorM2 = 200.0;      ///< surface with the expected density that the estimate begins with; chosen
constexpr double kClearlyBetter = 0.1;  ///< least improvement of quality that counts; chosen
/// Detections of two UAVs may be of the same point up to this distance, in standard deviations of their relative
/// position along an axis. Chosen.
constexpr double kMergeSigmas = 2.0;
constexpr double kFacing = 0.17;                    ///< least cosine between line of sight and a face's normal; chosen
constexpr double kClear = 0.6, kClearFacing = 0.3;  ///< clear view of a point: least quality; least such cosine; chosen
constexpr double kMiddle = 0.6;                     ///< ... within this share of the picture's width and height; chosen
constexpr double kMostAbove = 0.3;                  ///< ... sine of the most elevation above the camera; chosen
constexpr double kRangeRatio = 1.6;  ///< most distance of a face, in units of d*: farther ones are not sharp; chosen

VoxelGrid site_grid(const std::vector<OrientedBox>& boxes, const FlockConfig& config, double sharp_m) {
  double voxel_m = config.voxel_m;
  if (voxel_m == 0.0) voxel_m = std::clamp(kAutoVoxelRatio * sharp_m, kSmallestVoxelM, kLargestVoxelM);
  return limited_volume(boxes, FlockSurvey::kAroundM, voxel_m, config.max_voxels);
}

}  // namespace

FlockSurfaces::FlockSurfaces(const FlockConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                             double sharp_m, bool blind)
    : config_(config),
      agent_(agent),
      sharp_m_(sharp_m),
      blind_(blind),
      grid_(site_grid(boxes, config, sharp_m)),
      voxels_({.around_m = kFreeAroundM}),
      survey_(boxes, config.survey_m),
      // Formula: norm / sqrt(3) is the deviation per axis; that of a difference of two errors is sqrt(2) times as much.
      points_(kMergeSigmas * std::sqrt(2.0 / 3.0) * deviation_in_flight_m(agent.odometry).norm()),
      listed_(grid_.count(), 0),
      in_site_(grid_.count(), 0),
      looked_here_(grid_.count(), 0) {
  const double margin_m = FlockSurvey::kBoxMarginM + 0.5 * grid_.voxel_m();
  for (Id id = 0; id < grid_.count(); ++id) {
    const Vector3d centre = grid_.centre_W(id);
    in_site_[id] = std::ranges::any_of(boxes, [&](const OrientedBox& box) { return box.contains(centre, margin_m); });
  }
  if (blind_ && agent.first_explorer()) nothing_told_ = grid_;
  if (blind_) fill_boxes(boxes, grid_);
}

void FlockSurfaces::look_at_map(const WorldMap& map) {
  voxels_.update(map, grid_);
  for (const Id id : grid_.take_changed()) {
    if (grid_.state(id) != VoxelState::occupied || listed_[id] != 0 || in_site_[id] == 0) continue;
    if (grid_.centre_W(id).z() + 0.5 * grid_.voxel_m() < kLowestM) continue;
    list(id);
  }
  faces_ = looked_ = 0;
  for (const Cube& cube : occupied_) {
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      if (!exposed(cube, face)) continue;
      ++faces_;
      if (looked_at(cube.id, face)) ++looked_;
    }
  }
}

void FlockSurfaces::list(Id id) {
  Cube& cube = occupied_.emplace_back(Cube{.id = id});
  for (std::size_t face = 0; face < cube.next.size(); ++face) {
    const std::optional<Id> next = grid_.neighbour(id, static_cast<int>(face));
    cube.next[face] = next.value_or(kOutside);
    cube.survey_cell[face] = next ? survey_.cell_at(grid_.centre_W(*next)).value_or(kOutside) : kOutside;
  }
  listed_[id] = static_cast<std::uint32_t>(occupied_.size());
}

bool FlockSurfaces::exposed(const Cube& cube, int face) const {
  const auto at = static_cast<std::size_t>(face);
  const Id next = cube.next[at], survey_cell = cube.survey_cell[at];
  if (next == kOutside || grid_.state(next) == VoxelState::occupied) return false;
  return blind_ || grid_.state(next) == VoxelState::free || survey_cell == kOutside || survey_.seen(survey_cell);
}

Vector3d FlockSurfaces::surface_W(Id id) const { return voxels_.surface_W(id).value_or(grid_.centre_W(id)); }

bool FlockSurfaces::sees(const Vector3d& p_WC, const Vector3d& p_W) const {
  const Vector3d way = p_WC - p_W;
  const double length = way.norm(), end_m = kEndCubes * grid_.voxel_m();
  return length <= end_m || grid_.sees(p_WC, p_W + way * (end_m / length));
}

double FlockSurfaces::detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC) {
  if (detected.empty()) return 0.0;
  const double gained = points_.detect(detected, p_WC);
  for (const Look& look : std::exchange(not_told_, {})) {
    if (look.shown) grid_.mark(look.id, look.face);
  }
  return gained;
}

void FlockSurfaces::forget_pictures() {
  for (auto look = not_told_.rbegin(); look != not_told_.rend(); ++look) {
    occupied_[listed_[look->id] - 1].tenths[static_cast<std::size_t>(look->face)] = look->tenths;
    const std::uint8_t shown = look->shown ? static_cast<std::uint8_t>(1U << look->face) : std::uint8_t{0};
    looked_here_[look->id] = static_cast<std::uint8_t>(looked_here_[look->id] & ~shown);
  }
  not_told_.clear();
  points_.expect_again();
}

std::vector<std::size_t> FlockSurfaces::clear_points(const Exposure& exposure, Tick now) const {
  const double width = kMiddle * std::tan(0.5 * agent_.vehicle.camera.hfov_deg * kRadPerDeg);
  const double height = kMiddle * std::tan(0.5 * agent_.vehicle.camera.vfov_deg * kRadPerDeg);
  const std::vector<FlockPoint>& points = points_.all();
  std::vector<std::size_t> clear;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto p_C = exposure.view(points[i].p_W);
    if (!p_C || points[i].not_before > now) continue;
    const Vector3d way = exposure.position() - points[i].p_W;
    const double off_m = way.norm();
    const bool framed = std::abs(p_C->y()) < width * p_C->x() && std::abs(p_C->z()) < height * p_C->x();
    // The UAV's own body hides what is above the camera.
    if (!framed || points[i].n_W.dot(way) < kClearFacing * off_m || -way.z() > kMostAbove * off_m) continue;
    const auto score = exposure.score(*p_C, points[i].n_W);
    if (score && score->score() >= kClear && sees(exposure.position(), points[i].p_W)) clear.push_back(i);
  }
  return clear;
}

std::vector<FlockTarget> FlockSurfaces::known_points() const {
  std::vector<FlockTarget> targets;
  for (const FlockPoint& point : points_.all()) {
    const auto number = static_cast<std::uint32_t>(targets.size());
    targets.push_back({point.p_W, point.n_W, 1.0, 0.0, true, 2 * number + 1});
  }
  return targets;
}

void FlockSurfaces::look_at_picture(const Exposure& exposure, Tick now) {
  look_at_faces(exposure);
  const std::vector<FlockPoint>& points = points_.all();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto p_C = exposure.view(points[i].p_W);
    if (!p_C || points[i].q >= config_.good_q || points[i].n_W.dot(exposure.position() - points[i].p_W) <= 0.0)
      continue;
    const auto score = exposure.score(*p_C, points[i].n_W);
    const bool better = score && score->score() > points[i].q + kClearlyBetter;
    if (better && sees(exposure.position(), points[i].p_W)) points_.expect_better(i, now);
  }
}

void FlockSurfaces::look_at_faces(const Exposure& exposure) {
  const Vector3d& p_WC = exposure.position();
  const auto here = grid_.at(p_WC);
  if (!here) return;
  const double range_m = kPictureRatio * sharp_m_;
  grid_.around(*here, static_cast<int>(std::ceil(range_m / grid_.voxel_m())), [&](Id id) {
    if (listed_[id] == 0) return;
    Cube& cube = occupied_[listed_[id] - 1];
    const Vector3d surface = surface_W(id);
    const double off_m = (p_WC - surface).norm();
    const auto p_C = exposure.view(surface);
    if (!p_C) return;
    bool asked = false;
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      if (looked_at(id, face) || !exposed(cube, face)) continue;
      const Vector3d n_W = grid_.normal_W(face);
      const double ahead_m = n_W.dot(p_WC - surface);
      const auto score = ahead_m > 0.0 ? exposure.score(*p_C, n_W) : std::nullopt;
      if (!score) continue;
      const bool near = off_m <= kRangeRatio * sharp_m_ && ahead_m >= kFacing * off_m;
      const bool shown = near && score->score() >= config_.looked_q;
      std::uint8_t& best = cube.tenths[static_cast<std::size_t>(face)];
      const auto tenths = static_cast<std::uint8_t>(10.0 * score->score());  // format: tenths
      if (!shown && tenths <= best) continue;
      if (!asked && !sees(p_WC, surface)) return;
      asked = true;
      not_told_.push_back({id, face, best, shown});
      best = std::max(best, tenths);
      if (shown) looked_here_[id] = static_cast<std::uint8_t>(looked_here_[id] | 1U << face);
    }
  });
}

double FlockSurfaces::density() const {
  const double looked_m2 = voxel_area() * static_cast<double>(looked_);
  return (static_cast<double>(points_.all().size()) + config_.density * kPriorM2) / (looked_m2 + kPriorM2);
}

void FlockSurfaces::leave_out(const FlockTarget& target, Tick now) {
  std::erase_if(left_out_, [&](const auto& left_out) { return left_out.second <= now; });
  left_out_[target.id] = now + ticks(FlockPoints::kLeftOutS);
}

std::vector<FlockTarget> FlockSurfaces::targets(Tick now) const {
  std::vector<FlockTarget> targets;
  const auto add = [&](FlockTarget target) {
    const auto left_out = left_out_.find(target.id);
    if (left_out == left_out_.end() || left_out->second <= now) targets.push_back(target);
  };
  const double expected = density() * voxel_area();
  for (std::uint32_t place = 0; place < occupied_.size(); ++place) {
    const Cube& cube = occupied_[place];
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      if (looked_at(cube.id, face) || !exposed(cube, face)) continue;
      // Format: tenths.
      const double have = 0.1 * cube.tenths[static_cast<std::size_t>(face)];
      const auto number = place * VoxelGrid::kFaces + static_cast<std::uint32_t>(face);
      add({surface_W(cube.id), grid_.normal_W(face), expected, have, false, 2 * number});
    }
  }
  const std::vector<FlockPoint>& points = points_.all();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i].q >= config_.good_q || points[i].not_before > now) continue;
    add({points[i].p_W, points[i].n_W, 1.0, points[i].q, true, 2 * i + 1});
  }
  return targets;
}

}  // namespace skein::agent
