#include "uav_agent/planners/xxh/region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <tuple>

namespace skein::agent {
namespace {

constexpr double kPlacesM = 6.0;         ///< distance between two places on the spiral; chosen
constexpr double kSameM = 1.0;           ///< places nearer than this to the last one are left out; chosen
constexpr double kBoxMarginM = 0.5;      ///< surface this far outside the box still belongs to it; chosen
constexpr double kUnknownShare = 0.1;    ///< of its cells, most that may be unknown in an empty section; chosen
constexpr double kTilt = 0.8;            ///< slope of stops above, below and beside the targets; chosen
constexpr double kSteep = 0.9;           ///< vertical part of a direction that counts as up or down; chosen
constexpr std::size_t kMostTries = 120;  ///< cells whose stops are tried in one search; chosen

Isometry3d grid_pose(const OrientedBox& box, int axis, bool from_high_end, double margin_m, Vector3d& size_G) {
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  const double sign = from_high_end ? -1.0 : 1.0;
  Isometry3d X_WG = Isometry3d::Identity();
  X_WG.linear().col(0) = box.R_WO.col(u);
  X_WG.linear().col(1) = sign * box.R_WO.col(w);
  X_WG.linear().col(2) = sign * box.R_WO.col(axis);
  size_G = Vector3d(box.size[u], box.size[w], box.size[axis]) + Vector3d::Constant(2.0 * margin_m);
  X_WG.translation() = box.center - X_WG.linear() * (0.5 * size_G);
  return X_WG;
}

}  // namespace

XxhRegionMap::XxhRegionMap(const Config& config, const OrientedBox& box, int axis, bool from_high_end)
    : config_(config),
      box_(box),
      X_WG_(grid_pose(box, axis, from_high_end, config.margin_m, size_G_)),
      grid_(X_WG_, size_G_, config.voxel_m) {}

void XxhRegionMap::assume_solid() { fill_boxes({box_}, grid_); }

bool XxhRegionMap::anything_known() const {
  for (VoxelGrid::Id id = 0; id < grid_.count(); ++id) {
    if (grid_.state(id) == VoxelState::occupied && box_.contains(grid_.centre_W(id))) return true;
  }
  return false;
}

bool XxhRegionMap::is_empty(const Section& section) const {
  int cells = 0, unknown = 0;
  for (VoxelGrid::Id id = 0; id < grid_.count(); ++id) {
    const bool counts = layer(id) >= section.first && layer(id) < section.last && box_.contains(grid_.centre_W(id));
    if (!counts) continue;
    if (grid_.state(id) == VoxelState::occupied) return false;
    ++cells;
    unknown += grid_.state(id) == VoxelState::unknown ? 1 : 0;
  }
  return cells > 0 && unknown <= kUnknownShare * cells;
}

int XxhRegionMap::core_first() const { return static_cast<int>(config_.margin_m / config_.voxel_m); }

int XxhRegionMap::core_last() const {
  const double end_m = size_G_.z() - config_.margin_m;
  return std::clamp(static_cast<int>(std::ceil(end_m / config_.voxel_m)), core_first() + 1, grid_.dims().z());
}

XxhRegionMap::Section XxhRegionMap::section(std::size_t index, std::size_t count, double last_share) const {
  const double per_part = (core_last() - core_first()) / (static_cast<double>(count) - 1.0 + last_share);
  const auto part = [&](std::size_t i) {
    return core_first() + static_cast<int>(std::lround(static_cast<double>(i) * per_part));
  };
  return {index == 0 ? 0 : part(index), index + 1 == count ? grid_.dims().z() : part(index + 1)};
}

/// Layers of the spiral's turns, each in the middle of the layers that it covers; at least one.
std::vector<int> XxhRegionMap::turns() const {
  const int layers = core_last() - core_first();
  const int count = std::max(1, (layers + config_.spiral_step / 2) / config_.spiral_step);
  std::vector<int> turns;
  for (int i = 0; i < count; ++i) turns.push_back(core_first() + (2 * i + 1) * layers / (2 * count));
  return turns;
}

std::vector<Vector3d> XxhRegionMap::spiral(const Section& section, const Vector3d& from_W, bool bottom_only) const {
  const int first = std::max(section.first, core_first()), last = std::min(section.last, core_last());
  if (first >= last) return {};
  // Corners of the turn, in the layer's plane, about the middle of the region.
  const double a = 0.5 * size_G_.x() - config_.margin_m + config_.rim_m;
  const double b = 0.5 * size_G_.y() - config_.margin_m + config_.rim_m;
  const std::array<Vector2d, 4> corners = {Vector2d(-a, -b), Vector2d(a, -b), Vector2d(a, b), Vector2d(-a, b)};
  const auto place = [&](const Vector2d& p, int layer) {
    const Vector3d p_G(0.5 * size_G_.x() + p.x(), 0.5 * size_G_.y() + p.y(), (layer + 0.5) * config_.voxel_m);
    Vector3d p_W = X_WG_ * p_G;
    p_W.z() = std::max(p_W.z(), config_.lowest_m);
    return p_W;
  };
  std::size_t begin = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if ((place(corners[i], first) - from_W).norm() < (place(corners[begin], first) - from_W).norm()) begin = i;
  }
  std::vector<Vector3d> places;
  for (const int layer : bottom_only ? std::vector<int>{first} : turns()) {
    if (layer < first || layer >= last) continue;
    for (std::size_t side = 0; side < corners.size(); ++side) {
      const Vector2d& p = corners[(begin + side) % 4];
      const Vector2d& q = corners[(begin + side + 1) % 4];
      const int steps = std::max(1, static_cast<int>(std::ceil((q - p).norm() / kPlacesM)));
      for (int s = 0; s < steps; ++s) {
        const Vector3d next = place(p + (q - p) * s / steps, layer);
        if (places.empty() || (next - places.back()).norm() > kSameM) places.push_back(next);
      }
    }
  }
  return places;
}

std::vector<XxhTarget> XxhRegionMap::targets(VoxelGrid::Id cell) const {
  std::vector<XxhTarget> found;
  if (grid_.state(cell) == VoxelState::occupied) return found;
  for (int side = 0; side < VoxelGrid::kFaces; ++side) {
    const auto cube = grid_.neighbour(cell, side);
    const int face = VoxelGrid::opposite(side);
    if (!cube || grid_.state(*cube) != VoxelState::occupied || grid_.marked(*cube, face)) continue;
    const Vector3d surface = voxels_.surface_W(*cube).value_or(grid_.centre_W(*cube));
    if (!box_.contains(surface, kBoxMarginM)) continue;
    found.push_back({*cube, face, surface, grid_.normal_W(face)});
  }
  return found;
}

std::optional<Vector3d> XxhRegionMap::stop_at(VoxelGrid::Id cell, const std::vector<XxhTarget>& targets,
                                              const FreeSpace& space) const {
  const Vector3d centre = grid_.centre_W(cell);
  Vector3d out = Vector3d::Zero();
  double depth = std::numeric_limits<double>::infinity();
  for (const XxhTarget& target : targets) {
    out += target.out_W;
    depth = std::min(depth, (centre - target.surface_W).dot(target.out_W));
  }
  // Between walls that face each other, the cell's centre is the only place.
  if (out.norm() < 0.5) return space.free(centre) ? std::optional(centre) : std::nullopt;
  out.normalize();
  const double far = std::max(config_.farthest_m, config_.nearest_m), near = config_.nearest_m;
  const Vector3d foot = centre - depth * out;
  const Vector3d up = Vector3d::UnitZ(), aside = std::abs(out.z()) < kSteep ? Vector3d(up.cross(out)) : out;
  for (const double distance : {far, 0.5 * (far + near), near, config_.limit_m}) {
    for (const Vector3d& tilt : {Vector3d(0.0, 0.0, 0.0), up, Vector3d(-up), aside, Vector3d(-aside)}) {
      Vector3d p_W = foot + distance * (out + kTilt * tilt).normalized();
      p_W.z() = std::max(p_W.z(), config_.lowest_m);
      if (space.free(p_W)) return p_W;
    }
  }
  return std::nullopt;
}

VoxelGrid::Id XxhRegionMap::cell_at(const Vector3d& p_W) const {
  const Vector3d p_G = X_WG_.inverse() * p_W / config_.voxel_m;
  VoxelGrid::Cell cell;
  for (int i = 0; i < 3; ++i) cell[i] = static_cast<int>(std::clamp(p_G[i], 0.0, grid_.dims()[i] - 1.0));
  return *grid_.at(cell);
}

/// The cells of a layer that can be reached, by number of steps from cell to cell.
std::vector<VoxelGrid::Id> XxhRegionMap::reachable(VoxelGrid::Id from, int layer) const {
  std::vector<VoxelGrid::Id> cells;
  std::vector<bool> met(grid_.count());
  std::deque<VoxelGrid::Id> queue = {from};
  met[from] = true;
  while (!queue.empty()) {
    const VoxelGrid::Id cell = queue.front();
    queue.pop_front();
    if (this->layer(cell) == layer) cells.push_back(cell);
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      const auto next = grid_.neighbour(cell, face);
      if (!next || met[*next] || grid_.state(*next) == VoxelState::occupied) continue;
      met[*next] = true;
      queue.push_back(*next);
    }
  }
  return cells;
}

/// Sorts cells once around the axis, beginning at a cell, in sectors as wide as a cell at the rim.
void XxhRegionMap::sort_around(VoxelGrid::Id from, std::vector<VoxelGrid::Id>& cells) const {
  const Vector2d middle = 0.5 * (grid_.dims().head<2>().cast<double>() - Vector2d::Ones());
  const auto off_axis = [&](VoxelGrid::Id id) { return Vector2d(grid_.cell(id).head<2>().cast<double>() - middle); };
  const auto angle = [](const Vector2d& p) { return std::atan2(p.y(), p.x()); };
  constexpr double kTurn = 2.0 * std::numbers::pi;  // geometry
  // Geometry: at least one sector for each of the four sides.
  const int sectors = std::max(4, 2 * static_cast<int>(middle.x() + middle.y()));
  const double begin = angle(off_axis(from));
  std::vector<std::tuple<int, double, VoxelGrid::Id>> keys;
  for (const VoxelGrid::Id id : cells) {
    const Vector2d p = off_axis(id);
    const double ahead = angle(p) - begin + kTurn / (2.0 * sectors);  // the sector about `from` comes first
    const int sector = static_cast<int>((ahead - kTurn * std::floor(ahead / kTurn)) / kTurn * sectors);
    keys.emplace_back(sector, -p.squaredNorm(), id);
  }
  std::ranges::sort(keys);
  for (std::size_t i = 0; i < keys.size(); ++i) cells[i] = std::get<2>(keys[i]);
}

std::vector<XxhVisit> XxhRegionMap::visits(const Vector3d& from_W, int layer, XxhOrder order, const FreeSpace& space,
                                           const std::set<VoxelGrid::Id>& skip, std::size_t most) const {
  const VoxelGrid::Id from = cell_at(from_W);
  std::vector<VoxelGrid::Id> cells = reachable(from, layer);
  if (order == XxhOrder::spiral) sort_around(from, cells);
  std::vector<XxhVisit> visits;
  std::size_t tries = 0;
  for (const VoxelGrid::Id cell : cells) {
    if (visits.size() >= most || tries >= kMostTries) break;
    if (skip.contains(cell)) continue;
    auto looks = targets(cell);
    if (looks.empty()) continue;
    ++tries;
    if (const auto stop = stop_at(cell, looks, space)) visits.push_back({cell, *stop, std::move(looks)});
  }
  return visits;
}

}  // namespace skein::agent
