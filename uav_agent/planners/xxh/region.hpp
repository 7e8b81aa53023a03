// The voxel map of one region of XXH, cut into layers across the region's longest edge, and what follows from it: the
// spiral around the region, the sections of its layers that the members of a team take, and the cells to be visited.
// Frames: W world, G grid: z along the longest edge, away from the end at which the region is entered.   Units: metres.
// Threads: one.   Deterministic.   Effort: in proportion to the cells of the region.
// Source: paper, "Exploration Strategy" and "Inspection Strategy" of Team XXH; its public code for cells of 2.5 m, the
// margin of 6 m and one gimbal target for each occupied face neighbour. How far the spiral is from the box, the
// distance between its turns, what a spiral is among the cells of a layer, and where exactly in front of a cell's
// targets a UAV stops are our choice.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/world_voxels.hpp"
#include "uav_agent/planners/xxh/config.hpp"

namespace skein::agent {

/// One look from a cell: at the face of an occupied cell beside it.
struct XxhTarget {
  VoxelGrid::Id cube = 0;
  int face = 0;                           ///< of the cube, towards the cell
  Vector3d surface_W = Vector3d::Zero();  ///< where the camera looks
  Vector3d out_W = Vector3d::UnitX();     ///< outward normal of the face
};

/// One cell to visit.
struct XxhVisit {
  VoxelGrid::Id cell = 0;
  Vector3d p_WB = Vector3d::Zero();  ///< where the UAV stops
  std::vector<XxhTarget> targets;    ///< not looked at yet
};

class XxhRegionMap {
 public:
  struct Config {
    double voxel_m = 2.5, margin_m = 6.0;
    double rim_m = 4.0;
    int spiral_step = 6;
    double lowest_m = 2.5;                     ///< of places on the spiral, and of stops
    double nearest_m = 2.1, farthest_m = 3.7;  ///< stops from the surface; as far as there is room
    double limit_m = 6.0;                      ///< or, if there is none, so far
  };
  /// Layers [first, last).
  struct Section {
    int first = 0, last = 0;
  };

  /// @param box  of the region.   @param axis  across the layers.   @param from_high_end  of that axis it is entered.
  XxhRegionMap(const Config& config, const OrientedBox& box, int axis, bool from_high_end);

  VoxelGrid& grid() { return grid_; }
  const VoxelGrid& grid() const { return grid_; }
  const OrientedBox& box() const { return box_; }
  int layer(VoxelGrid::Id id) const { return grid_.cell(id).z(); }

  /// What this UAV's map shows, into the grid.   @param map  the same at each call.
  void update(const WorldMap& map) { voxels_.update(map, grid_); }
  /// Takes the box for solid: all that somebody can go by who has nobody with a LiDAR.
  void assume_solid();
  bool anything_known() const;
  /// All of a section's cells in the box that matter are known, and nothing is there.
  bool is_empty(const Section& section) const;

  /// Part `index` of `count`; the margin belongs to the first and the last.
  /// @param last_share  size of the last one, in units of each other.
  Section section(std::size_t index, std::size_t count, double last_share) const;

  /// Places of the spiral's turns that are in a section, each once around the region, beginning at the corner nearest
  /// to `from_W`. A thin section may have none: it is seen from the turns beside it.
  /// @param bottom_only  just one turn, at the section's first layer.
  std::vector<Vector3d> spiral(const Section& section, const Vector3d& from_W, bool bottom_only = false) const;

  /// The cells of a layer that have targets and can be reached from `from_W` through cells that are not occupied, at
  /// most `most` of those that have a free place to stop at.
  /// @param from_W  is brought into the grid.   @param order  nearest: by the number of steps. spiral: the next one
  /// around the region first, in the sense in which the explorer flies; of those in one direction the outermost.
  /// @param skip  cells that are left out.
  std::vector<XxhVisit> visits(const Vector3d& from_W, int layer, XxhOrder order, const FreeSpace& space,
                               const std::map<VoxelGrid::Id, int>& skip, std::size_t most) const;
  /// Without places to stop at; empty if the cell is no place to look from.
  std::vector<XxhTarget> targets(VoxelGrid::Id cell) const;

 private:
  int core_first() const;
  int core_last() const;
  std::vector<int> turns() const;
  VoxelGrid::Id cell_at(const Vector3d& p_W) const;
  std::vector<VoxelGrid::Id> reachable(VoxelGrid::Id from, int layer) const;
  void sort_around(VoxelGrid::Id from, std::vector<VoxelGrid::Id>& cells) const;
  std::optional<Vector3d> stop_at(VoxelGrid::Id cell, const std::vector<XxhTarget>& targets,
                                  const FreeSpace& space) const;

  const Config config_;
  const OrientedBox box_;
  Isometry3d X_WG_;
  Vector3d size_G_;
  VoxelGrid grid_;
  WorldVoxels voxels_;
};

}  // namespace skein::agent
