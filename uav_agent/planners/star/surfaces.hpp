// Surface that STAR's photographers have to inspect: marks the surface that was in the picture, divides the rest into
// patches, and finds for each patch the viewpoint from which most of it is seen. Marks belong to the faces of occupied
// cubes (voxel_grid.hpp) and are sent with the map.
// Frames: W world, C camera.   Units: SI and radians.   Threads: one.   Effort: bounded by counts.
// Source: paper ("surfaces are detected and clustered", "viewpoints are generated and selected accordingly");
// viewpoints before a face at five tilts are our choice. Surface in the picture counts as inspected if it was near
// enough and not too oblique (`seen_ratio`, `oblique_deg`), however blurred: the sources mention no check of quality,
// and the published quality is low.
#pragma once

#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/world_voxels.hpp"
#include "uav_agent/planners/star/config.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {

/// A viewpoint of a patch of surface.
struct StarView {
  Vector3d p_WB = Vector3d::Zero();
  Vector3d surface_W = Vector3d::Zero();  ///< middle of the patch
  std::vector<std::uint32_t> faces = {};  ///< faces of the patch, as 6 * cube + face
};

class StarSurfaces {
 public:
  struct Config {
    double sharp_m = CameraReach().sharp_distance_m;  ///< d*
    double standoff_ratio = 0.7;                  ///< distance of a viewpoint to the surface, in units of d*; chosen
    double seen_ratio = StarConfig().seen_ratio;  ///< a surface seen from within this, in units of d*, ...
    double oblique = 1.2;                         ///< ... and within this angle of its normal, is inspected; chosen
    double patch_m = 6.0;                         ///< largest extent of a patch; chosen
    std::size_t max_views = static_cast<std::size_t>(StarConfig().max_views);
    double retry_s = 10.0;   ///< wait before a face is tried again, times failures to reach its viewpoint; chosen
    double no_view_s = 3.0;  ///< wait for a face without a viewpoint: more space may be proved free by then; chosen
  };

  /// @param grid  only its size is used.
  StarSurfaces(const Config& config, const VehicleConfig& vehicle, const VoxelGrid& grid)
      : config_(config), vehicle_(vehicle), failures_(VoxelGrid::kFaces * std::size_t{grid.count()}) {}

  /// Marks the surface that the camera sees now.
  void mark_seen(const RigidBodyState& state, const GimbalState& gimbal, const WorldVoxels& voxels,
                 VoxelGrid& grid) const;

  /// Viewpoints for the surface left to inspect, for the patches nearest to `p_W`.
  /// @param cubes  the cubes that this UAV's team works on.
  std::vector<StarView> views(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& cubes, const WorldVoxels& voxels,
                              const FreeSpace& space, const Vector3d& p_W, Tick now);

  /// Whether more than half of a patch is still to be inspected.
  static bool open(const VoxelGrid& grid, const StarView& view);
  /// The nearest surface in sight that was not inspected yet; nullopt: none within the range of inspection.
  std::optional<Vector3d> nearest_open_W(const VoxelGrid& grid, const WorldVoxels& voxels, const Vector3d& p_W) const;

  /// The view could not be reached: views() leaves its faces out for a while (Config::retry_s).
  void failed(const StarView& view, Tick now);

 private:
  struct Patch {
    std::vector<std::uint32_t> faces;
    std::vector<Vector3d> surface_W;
    Vector3d middle_W = Vector3d::Zero();
    int face = 0;
    double distance = 0.0;
  };
  struct Failure {
    Tick not_before = 0;
    std::uint8_t count = 0;
  };

  std::vector<Patch> patches(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& cubes, const WorldVoxels& voxels,
                             const Vector3d& p_W, Tick now) const;
  std::optional<StarView> best_view(const VoxelGrid& grid, const Patch& patch, const FreeSpace& space) const;

  const Config config_;
  const VehicleConfig vehicle_;
  std::vector<Failure> failures_;  ///< by face
};

}  // namespace skein::agent
