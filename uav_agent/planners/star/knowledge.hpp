// What one UAV of STAR knows of the structure: the cubes of the site, from its own map and from what the others told,
// and what follows from them: which surfaces are left to inspect, and which frontiers to explore.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/star/site.hpp"

namespace skein::agent {

class StarKnowledge {
 public:
  /// Nothing but the boxes, which a fleet without a LiDAR takes for solid.
  /// @param own_boxes  the team's.   @param agent  must outlive this.
  StarKnowledge(const StarConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                const std::vector<std::size_t>& own_boxes);

  /// Another team's boxes, too.
  void work_on(const std::vector<OrientedBox>& boxes, const std::vector<std::size_t>& own_boxes) {
    cubes_ = cubes_of_boxes(grid_, boxes, own_boxes);
  }

  VoxelGrid& grid() { return grid_; }
  const VoxelGrid& grid() const { return grid_; }
  StarSurfaces& surfaces() { return surfaces_; }
  StarExplorer& explorer() { return explorer_; }

  /// Takes in what beams have proved; an explorer also what lies in view of its own.
  void look_at_map(const WorldMap& map, const Vector3d& p_WB);
  /// Takes in what the camera sees now.
  void look_at_picture(const RigidBodyState& state, const GimbalState& gimbal);

  /// Viewpoints of surface in the team's boxes that is left, near `p_W`.
  std::vector<StarView> views(const FreeSpace& space, const Vector3d& p_W, Tick now);
  /// The middle of the nearest surface in sight that was not inspected; nullopt: none within range.
  std::optional<Vector3d> nearest_open_W(const Vector3d& p_W) const;

 private:
  const AgentConfig& agent_;
  WorldVoxels voxels_;
  VoxelGrid grid_;
  std::vector<VoxelGrid::Id> cubes_;  ///< in the team's boxes
  StarSurfaces surfaces_;
  StarExplorer explorer_;
};

}  // namespace skein::agent
