// Which parts of the site an explorer has had in sight, near enough for its LiDAR to find all structure. A part that
// has not been in sight is worth a flight there; places that never are lie inside structure.
// Each UAV keeps count for itself, of its own LiDAR and of those of the explorers that it sees.
// Frame W.   Units: metres.   Threads: one.   Effort of look(): cells within survey_m.
#pragma once

#include <vector>

#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

/// A part of the site that has not been in sight long enough.
struct FlockGap {
  Vector3d middle_W = Vector3d::Zero();
  int cells = 0;
};

class FlockSurvey {
 public:
  static constexpr double kCellM = 4.0;

  FlockSurvey(const std::vector<OrientedBox>& boxes, double survey_m);

  /// An explorer has been about here for a second.
  /// @param grid  what hides other things.
  void look(const VoxelGrid& grid, const Vector3d& p_W);

  /// This UAV has been at a place from which it meant to survey what is within `radius_m`. What stays out of sight
  /// after two such visits is given up: a corner of a cell may be in sight where its middle is not.
  void visited(const Vector3d& p_W, double radius_m);

  /// Whether an explorer ever had the place in sight.
  bool seen(const Vector3d& p_W) const;
  /// Cells in boxes and about them that were not in sight long enough, in groups.
  std::vector<FlockGap> gaps() const;
  std::size_t surveyed() const { return surveyed_; }
  std::size_t to_survey() const { return to_survey_; }

 private:
  double survey_m_;
  VoxelGrid cells_;
  std::vector<std::uint8_t> wanted_, looks_, visits_;  ///< by cell
  std::size_t surveyed_ = 0, to_survey_ = 0;
};

}  // namespace skein::agent
