// Which parts of the site explorers have surveyed: parts that were in line of sight of an explorer, and near enough for
// its LiDAR to find all structure. Other parts are worth a flight, except those inside structure, which are never in
// sight.
// Each UAV keeps its own record, of its own LiDAR and of those of the explorers in line of sight.
// Frame W.   Units: metres.   Threads: one.   Effort of look(): cells within survey_m.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

/// A group of neighbouring cells that have not been in sight long enough.
struct FlockGap {
  Vector3d middle_W = Vector3d::Zero();
  int cells = 0;  ///< number of cells in the group
};

class FlockSurvey {
 public:
  static constexpr double kCellM = 4.0;       ///< edge of a cell; larger on sites of more than 1 km³; chosen
  static constexpr double kAroundM = 12.0;    ///< margin of cells and of the map's grid around the boxes; chosen
  static constexpr double kBoxMarginM = 1.0;  ///< what is this far outside a box still belongs to it; chosen

  FlockSurvey(const std::vector<OrientedBox>& boxes, double survey_m);

  /// Counts a look of an explorer at p_W; call it once per second.
  /// @param grid  map of the structure that hides cells.
  void look(const VoxelGrid& grid, const Vector3d& p_W);

  /// Call it when this UAV was at a place chosen to survey everything within `radius_m`. gaps() gives up cells that are
  /// not surveyed after two such visits: a corner of a cell may be in sight although its middle is not.
  void visited(const Vector3d& p_W, double radius_m);

  /// The survey's cell with this place; nullopt outside the survey.
  std::optional<VoxelGrid::Id> cell_at(const Vector3d& p_W) const { return cells_.at(p_W); }
  /// Whether an explorer ever had the cell, or the place, in sight; true outside the survey's cells.
  bool seen(VoxelGrid::Id cell) const { return looks_[cell] > 0; }
  bool seen(const Vector3d& p_W) const;
  /// Cells in and near boxes that were not in sight long enough and have not been given up, in groups.
  std::vector<FlockGap> gaps() const;
  std::size_t surveyed() const { return surveyed_; }  ///< number of surveyed cells in and near boxes

 private:
  double survey_m_;
  VoxelGrid cells_;
  std::vector<std::uint8_t> wanted_, looks_, visits_;  ///< by cell
  std::size_t surveyed_ = 0;
};

}  // namespace skein::agent
