#include "uav_agent/planners/flock/survey.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace skein::agent {
namespace {

/// Looks, one per second, after which a cell is surveyed. Chosen: most of the 4 s in which the LiDAR covers all
/// directions.
constexpr int kEnoughLooks = 3;
constexpr int kMostVisits = 2;  ///< a cell that is not surveyed after this many visits is given up; chosen
constexpr int kGroup = 3;       ///< cells along an edge of a group; chosen

VoxelGrid cells_around(const std::vector<OrientedBox>& boxes) {
  const auto size_of = [&](double edge) { return operational_size(boxes, {}, FlockSurvey::kAroundM, 0.0, edge); };
  const double cell_m = fitting_voxel_m(FlockSurvey::kCellM, size_of);
  return operational_volume(boxes, {}, FlockSurvey::kAroundM, 0.0, cell_m);
}

}  // namespace

FlockSurvey::FlockSurvey(const std::vector<OrientedBox>& boxes, double survey_m)
    : survey_m_(survey_m),
      cells_(cells_around(boxes)),
      wanted_(cells_.count(), 0),
      looks_(cells_.count(), 0),
      visits_(cells_.count(), 0) {
  for (VoxelGrid::Id id = 0; id < cells_.count(); ++id) {
    const Vector3d centre = cells_.centre_W(id);
    const auto holds = [&](const OrientedBox& box) { return box.contains(centre, FlockSurvey::kBoxMarginM); };
    if (std::ranges::any_of(boxes, holds)) wanted_[id] = 1;
  }
}

void FlockSurvey::look(const VoxelGrid& grid, const Vector3d& p_W) {
  const auto [low, high] = cells_.cells_within(p_W, survey_m_);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const auto id = cells_.at(VoxelGrid::Cell(x, y, z));
        if (!id || looks_[*id] >= kEnoughLooks) continue;
        const Vector3d centre = cells_.centre_W(*id);
        if ((centre - p_W).squaredNorm() > survey_m_ * survey_m_ || !grid.sees(p_W, centre)) continue;
        if (++looks_[*id] == kEnoughLooks && wanted_[*id] != 0) ++surveyed_;
      }
    }
  }
}

void FlockSurvey::visited(const Vector3d& p_W, double radius_m) {
  for (VoxelGrid::Id id = 0; id < cells_.count(); ++id) {
    if (wanted_[id] == 0 || (cells_.centre_W(id) - p_W).squaredNorm() > radius_m * radius_m) continue;
    if (visits_[id] < kMostVisits) ++visits_[id];
  }
}

bool FlockSurvey::seen(const Vector3d& p_W) const {
  const auto cell = cell_at(p_W);
  return !cell || seen(*cell);
}

std::vector<FlockGap> FlockSurvey::gaps() const {
  std::map<std::tuple<int, int, int>, FlockGap> groups;
  for (VoxelGrid::Id id = 0; id < cells_.count(); ++id) {
    if (wanted_[id] == 0 || looks_[id] >= kEnoughLooks || visits_[id] >= kMostVisits) continue;
    const VoxelGrid::Cell cell = cells_.cell(id) / kGroup;
    FlockGap& gap = groups[{cell.x(), cell.y(), cell.z()}];
    gap.middle_W += cells_.centre_W(id);
    ++gap.cells;
  }
  std::vector<FlockGap> gaps;
  for (auto& [cell, gap] : groups) {
    gap.middle_W /= gap.cells;
    gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace skein::agent
