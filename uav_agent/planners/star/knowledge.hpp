// What one UAV of STAR knows about the structure: the cubes of the site, from its own map and the other UAVs' messages,
// and what follows from them: the surfaces left to inspect and the frontiers left to explore.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/planners/star/site.hpp"

namespace skein::agent {

class StarKnowledge {
 public:
  /// Begins with nothing but the boxes, which a fleet without a LiDAR takes for solid.
  /// @param own_boxes  the team's, as indices into `boxes`.   @param agent  must outlive this.
  StarKnowledge(const StarConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                const std::vector<std::size_t>& own_boxes);

  /// From now on, `own_boxes` are the boxes to work on.
  void work_on(const std::vector<OrientedBox>& boxes, const std::vector<std::size_t>& own_boxes) {
    cubes_ = cubes_of_boxes(grid_, boxes, own_boxes);
  }

  VoxelGrid& grid() { return grid_; }
  const VoxelGrid& grid() const { return grid_; }
  StarSurfaces& surfaces() { return surfaces_; }
  StarExplorer& explorer() { return explorer_; }

  /// Takes over what changed on the world map. On an explorer, also updates the frontiers and counts looks at them.
  void look_at_map(const WorldMap& map, const Vector3d& p_WB);
  /// Marks the surface that the camera sees now.
  void look_at_picture(const RigidBodyState& state, const GimbalState& gimbal);

  /// Viewpoints for the surface left in the team's boxes, nearest to `p_W` first.
  std::vector<StarView> views(const FreeSpace& space, const Vector3d& p_W, Tick now);
  /// The nearest surface in sight that was not inspected yet; nullopt: none within the range of inspection.
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
