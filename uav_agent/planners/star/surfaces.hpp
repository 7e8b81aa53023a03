// Surface that is known and not inspected yet, as STAR's photographers see it: marks what was in the picture, cuts what
// is left into patches, and finds for each the viewpoint from which most of it is seen. A mark is a face of an occupied
// cube (voxel_grid.hpp) and travels with the map.
// Frames: W world, C camera.   Units: SI and radians.   Threads: one.   Effort: bounded by counts.
// Source: paper ("surfaces are detected and clustered", "viewpoints are generated and selected accordingly");
// viewpoints before a face at five tilts are our choice. What was in the picture counts from near enough and not too
// obliquely (`seen_ratio`, `oblique_deg`), however blurred: nothing is known of any care for quality, and the published
// quality is low.
#pragma once

#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/world_voxels.hpp"

namespace skein::agent {

/// A place to look at a patch of surface from.
struct StarView {
  Vector3d p_WB = Vector3d::Zero();
  Vector3d surface_W = Vector3d::Zero();  ///< middle of the patch
  std::vector<std::uint32_t> faces = {};  ///< of the patch: 6 * cube + face
};

class StarSurfaces {
 public:
  struct Config {
    double sharp_m = 7.36;        ///< d*
    double standoff_ratio = 0.7;  ///< in units of d*
    double seen_ratio = 1.0;      ///< seen from so near, in units of d*, ...
    double oblique = 1.2;         ///< ... and no flatter than this, it is inspected
    double patch_m = 6.0;
    std::size_t max_views = 150;
    double retry_s = 10.0;   ///< before a face whose viewpoint was out of reach is tried again
    double no_view_s = 3.0;  ///< the same without a viewpoint: more space may have been proved
  };

  /// @param grid  for its size.
  StarSurfaces(const Config& config, const VehicleConfig& vehicle, const VoxelGrid& grid)
      : config_(config), vehicle_(vehicle), failures_(VoxelGrid::kFaces * std::size_t{grid.count()}) {}

  /// Marks what the camera sees now.
  void mark_seen(const RigidBodyState& state, const GimbalState& gimbal, const WorldVoxels& voxels,
                 VoxelGrid& grid) const;

  /// Viewpoints of what is left, of the patches nearest to `p_W`.
  /// @param cubes  that are somebody's business here.
  std::vector<StarView> views(const VoxelGrid& grid, const std::vector<VoxelGrid::Id>& cubes, const WorldVoxels& voxels,
                              const FreeSpace& space, const Vector3d& p_W, Tick now);

  /// Whether more than half of a patch is still to be inspected.
  static bool open(const VoxelGrid& grid, const StarView& view);
  /// The middle of the nearest surface in sight that was not inspected; nullopt: none within range.
  std::optional<Vector3d> nearest_open_W(const VoxelGrid& grid, const WorldVoxels& voxels, const Vector3d& p_W) const;

  /// It could not be reached: something else first.
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
