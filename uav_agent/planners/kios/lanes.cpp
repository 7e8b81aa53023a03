#include "uav_agent/planners/kios/lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace skein::agent {
namespace {

constexpr double kInsetM = 15.0;  ///< lanes end this far inside the boxes' extent: LiDARs reach farther; chosen
constexpr double kHeight = 0.3;   ///< of a lane in its level, as a share of the level: UAVs come from below; chosen

/// Ends of one lane.
struct Lane {
  Vector3d a_W, b_W;
};

/// The lane through a row of cubes, from cube ends.first to ends.second of the row, raised to the least height.
Lane lane_at(const VoxelGrid& volume, VoxelGrid::Cell cell, int along, std::pair<int, int> ends, double lowest_m) {
  Lane lane;
  cell[along] = ends.first;
  lane.a_W = volume.centre_W(*volume.at(cell));
  cell[along] = ends.second;
  lane.b_W = volume.centre_W(*volume.at(cell));
  lane.a_W.z() = std::max(lane.a_W.z(), lowest_m);
  lane.b_W.z() = std::max(lane.b_W.z(), lowest_m);
  return lane;
}

/// Whether a lane keeps a distance of one cube from all boxes.
bool leaves_boxes_alone(const Lane& lane, const VoxelGrid& volume, const std::vector<OrientedBox>& boxes) {
  const double step = 0.5 * volume.voxel_m();
  const int steps = static_cast<int>((lane.b_W - lane.a_W).norm() / step);
  for (int i = 0; i <= steps; ++i) {
    const Vector3d p = lane.a_W + (lane.b_W - lane.a_W) * (static_cast<double>(i) / std::max(1, steps));
    if (std::ranges::any_of(boxes, [&](const OrientedBox& box) { return box.contains(p, volume.voxel_m()); })) {
      return false;
    }
  }
  return true;
}

/// Extent of the boxes along an axis: the first and the last row of cubes that they reach.
std::pair<int, int> rows_of(const VoxelGrid& volume, const std::vector<OrientedBox>& boxes, int axis) {
  const double first = volume.centre_W(0)[axis];
  if (boxes.empty()) return {0, volume.dims()[axis] - 1};
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const OrientedBox& box : boxes) {
    const double half = (box.R_WO.cwiseAbs() * (0.5 * box.size))[axis];
    lo = std::min(lo, box.center[axis] - half);
    hi = std::max(hi, box.center[axis] + half);
  }
  const auto row = [&](double x) {
    return std::clamp(static_cast<int>(std::lround((x - first) / volume.voxel_m())), 0, volume.dims()[axis] - 1);
  };
  return {row(lo), row(hi)};
}

std::vector<Lane> all_lanes(const VoxelGrid& volume, const std::vector<OrientedBox>& boxes, double lowest_m,
                            int count) {
  const VoxelGrid::Cell& dims = volume.dims();
  int along = 0;
  dims.maxCoeff(&along);
  const int across = along == 0 ? 1 : 0, other = 3 - along - across;
  const int levels = (count + 1) / 2;
  const auto [low_row, high_row] = rows_of(volume, boxes, across);
  std::pair<int, int> ends = rows_of(volume, boxes, along);
  // Chosen: at least half of the extent is flown.
  const int inset = std::min((ends.second - ends.first) / 4, static_cast<int>(kInsetM / volume.voxel_m()));
  ends = {ends.first + inset, ends.second - inset};
  std::vector<Lane> lanes;
  for (int i = 0; i < count; ++i) {
    const int level = i / 2, side = i % 2 == 0 ? -1 : 1;
    VoxelGrid::Cell cell;
    cell[along] = 0;
    cell[other] = static_cast<int>(dims[other] * (level + (other == 2 ? kHeight : 0.5)) / levels);
    // Begins halfway between middle and rim of the boxes, and moves outwards until the lane keeps clear of them.
    // Halfway is chosen.
    const int first = static_cast<int>(std::lround(0.5 * (low_row + high_row) + side * 0.25 * (high_row - low_row)));
    for (cell[across] = first; cell[across] > 0 && cell[across] + 1 < dims[across]; cell[across] += side) {
      if (leaves_boxes_alone(lane_at(volume, cell, along, ends, lowest_m), volume, boxes)) break;
    }
    lanes.push_back(lane_at(volume, cell, along, ends, lowest_m));
  }
  return lanes;
}

}  // namespace

std::vector<Vector3d> mapping_lanes(const AgentConfig& agent, const VoxelGrid& volume,
                                    const std::vector<OrientedBox>& boxes, double lowest_m, int lanes) {
  std::vector<std::size_t> explorers;
  for (std::size_t uav = 0; uav < agent.fleet.size(); ++uav) {
    if (agent.fleet[uav].role == Role::explorer) explorers.push_back(uav);
  }
  if (agent.me().role != Role::explorer) return {};
  std::vector<Lane> left = all_lanes(volume, boxes, lowest_m, std::max(lanes, static_cast<int>(explorers.size())));
  std::vector<Vector3d> at;
  for (const std::size_t uav : explorers) at.push_back(agent.fleet[uav].p_WB_start);
  std::vector<Vector3d> own;
  // All explorers compute the same assignment: in turn, each takes the lane that has the nearest end.
  for (std::size_t turn = 0; !left.empty(); turn = (turn + 1) % explorers.size()) {
    std::size_t nearest = 0;
    bool reversed = false;
    double distance = -1.0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      for (const bool from_b : {false, true}) {
        const double d = ((from_b ? left[i].b_W : left[i].a_W) - at[turn]).head<2>().norm();
        if (distance >= 0.0 && d >= distance) continue;
        distance = d;
        nearest = i;
        reversed = from_b;
      }
    }
    Lane lane = left[nearest];
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(nearest));
    if (reversed) std::swap(lane.a_W, lane.b_W);
    at[turn] = lane.b_W;
    if (explorers[turn] == agent.self) own.insert(own.end(), {lane.a_W, lane.b_W});
  }
  return own;
}

}  // namespace skein::agent
