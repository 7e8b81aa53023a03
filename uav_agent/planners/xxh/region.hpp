// The voxel map of one region of XXH, divided into layers across the region's longest edge, and what follows from it:
// the spiral around the region, the sections of layers for the members of a team, and the cells to visit.
// Frames: W world, G grid: z along the longest edge, away from the end at which the region is entered.   Units: metres.
// Threads: one.   Deterministic.   Effort: in proportion to the cells of the region.
// Source: paper, "Exploration Strategy" and "Inspection Strategy" of Team XXH; its public code for cells of 2.5 m, the
// margin of 6 m and one gimbal target for each occupied face neighbour. Our choice: the distance of the spiral
// from the box and between its turns, the spiral order of the cells in a layer, and where exactly in front of a cell's
// targets a UAV stops.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/world_voxels.hpp"
#include "uav_agent/planners/xxh/config.hpp"

namespace skein::agent {

/// What to look at from a cell: the face of an occupied cube beside it.
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
  std::vector<XxhTarget> targets;    ///< targets that no UAV has looked at yet
};

class XxhRegionMap {
 public:
  struct Config {
    double voxel_m = XxhConfig().voxel_m;       ///< edge of a cell
    double margin_m = XxhConfig().margin_m;     ///< around the region
    double rim_m = XxhConfig().rim_m;           ///< distance from the box to the spiral
    int spiral_step = XxhConfig().spiral_step;  ///< layers between two turns of the spiral
    double lowest_m = 2.5;                      ///< least height of places on the spiral, and of stops; chosen
    /// Distances of a stop to the surface; the farthest is tried first. Chosen; worksite.cpp computes them.
    double nearest_m = 2.1, farthest_m = 3.7;
    double limit_m = 6.0;  ///< distance that is tried if there is no room at the others; chosen
  };
  /// Layers [first, last).
  struct Section {
    int first = 0, last = 0;
  };

  /// @param box  of the region.   @param axis  box axis across the layers.
  /// @param from_high_end  the region is entered at the high end of this axis.
  XxhRegionMap(const Config& config, const OrientedBox& box, int axis, bool from_high_end);

  VoxelGrid& grid() { return grid_; }
  const VoxelGrid& grid() const { return grid_; }
  const OrientedBox& box() const { return box_; }
  int layer(VoxelGrid::Id id) const { return grid_.cell(id).z(); }

  /// Takes over what this UAV's map shows.   @param map  the same at each call.
  void update(const WorldMap& map) { voxels_.update(map, grid_); }
  /// Takes the box for solid, for UAVs that have no LiDAR and receive no map.
  void assume_solid();
  bool anything_known() const;  ///< whether a cell in the box is occupied
  /// Whether no cell of the section in the box is occupied, and at most a tenth of them is unknown.
  bool is_empty(const Section& section) const;

  /// Section `index` of `count`; the margins belong to the first and the last section.
  /// @param last_share  size of the last section, in units of any other one.
  Section section(std::size_t index, std::size_t count, double last_share) const;

  /// Places along the spiral's turns in a section. Each turn goes once around the region and begins at the corner
  /// nearest to `from_W`. A thin section may have no turn: it is seen from the turns beside it.
  /// @param bottom_only  only one turn, at the section's first layer.
  std::vector<Vector3d> spiral(const Section& section, const Vector3d& from_W, bool bottom_only = false) const;

  /// Up to `most` cells of a layer that have targets and a free place to stop at, and that can be reached from `from_W`
  /// through cells that are not occupied.
  /// @param from_W  is moved to the nearest cell of the grid.   @param order  nearest: by the number of steps from cell
  /// to cell. spiral: around the region in the explorer's direction; of cells in one direction the outermost first.
  /// @param skip  cells to leave out.
  std::vector<XxhVisit> visits(const Vector3d& from_W, int layer, XxhOrder order, const FreeSpace& space,
                               const std::set<VoxelGrid::Id>& skip, std::size_t most) const;
  /// Targets of a cell, whether or not it has a place to stop at; empty if the cell is occupied.
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
