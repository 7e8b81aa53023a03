#include "uav_agent/planners/star/site.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kAutoVoxelRatio = 0.35;                       ///< edge of a cube by the camera, in units of d*; chosen
constexpr double kSmallestVoxelM = 2.0, kLargestVoxelM = 3.0;  ///< limits of this edge; chosen
constexpr double kAroundM = 12.0;                              ///< margin of the grid around the boxes; chosen
constexpr double kBesideM = 6.0;      ///< distance of a place beside a box from the box's circumscribed circle; chosen
constexpr int kWallDirections = 12;   ///< places beside a box; chosen
constexpr double kAboveFloorM = 2.0;  ///< least height of these places above the lowest permitted one; chosen

}  // namespace

VoxelGrid star_grid(const std::vector<OrientedBox>& boxes, const StarConfig& config, double sharp_m) {
  double voxel = config.voxel_m;
  if (voxel == 0.0) voxel = std::clamp(kAutoVoxelRatio * sharp_m, kSmallestVoxelM, kLargestVoxelM);
  return limited_volume(boxes, kAroundM, voxel, config.max_voxels);
}

std::vector<VoxelGrid::Id> cubes_of_boxes(const VoxelGrid& grid, const std::vector<OrientedBox>& boxes,
                                          const std::vector<std::size_t>& own_boxes) {
  std::vector<VoxelGrid::Id> cubes;
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    const Vector3d centre = grid.centre_W(id);
    const auto holder =
        std::ranges::find_if(boxes, [&](const OrientedBox& box) { return box.contains(centre, 0.5 * grid.voxel_m()); });
    if (holder == boxes.end()) continue;
    if (std::ranges::count(own_boxes, static_cast<std::size_t>(holder - boxes.begin())) > 0) cubes.push_back(id);
  }
  return cubes;
}

std::vector<Vector3d> places_beside(const OrientedBox& box, const FreeSpace& space, const Vector3d& p_W) {
  const double radius = 0.5 * box.size.head<2>().norm() + kBesideM;
  std::vector<Vector3d> places;
  for (int i = 0; i < kWallDirections; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kWallDirections;
    const Vector3d p(box.center.x() + radius * std::cos(turn), box.center.y() + radius * std::sin(turn),
                     std::max(box.center.z(), space.config().floor_m + kAboveFloorM));
    if (space.free(p)) places.push_back(p);
  }
  std::ranges::stable_sort(places, {}, [&](const Vector3d& p) { return (p - p_W).norm(); });
  return places;
}

StarSurfaces::Config surfaces_config(const StarConfig& config, const VehicleConfig& vehicle, double sharp_m) {
  StarSurfaces::Config surfaces;
  surfaces.sharp_m = sharp_m;
  surfaces.standoff_ratio = config.standoff_ratio;
  surfaces.seen_ratio = config.seen_ratio;
  surfaces.oblique = config.oblique_deg * kRadPerDeg;
  const double half_height = 0.5 * vehicle.camera.vfov_deg * kRadPerDeg;
  const double picture_m = 2.0 * config.standoff_ratio * sharp_m * std::tan(half_height);
  surfaces.patch_m = config.patch_m > 0.0 ? config.patch_m : picture_m;
  surfaces.max_views = static_cast<std::size_t>(config.max_views);
  return surfaces;
}

StarExplorer::Config explorer_config(const StarConfig& config) {
  StarExplorer::Config explorer;
  explorer.speed_mps = config.explore_mps;
  explorer.turn_s = config.turn_s;
  explorer.mate_s = config.mate_s.value();
  explorer.cluster_m = config.cluster_m;
  explorer.min_cluster = static_cast<std::size_t>(config.min_cluster);
  explorer.ring_inner_m = config.ring_inner_m;
  explorer.ring_outer_m = config.ring_outer_m;
  explorer.margin_m = config.margin_m;
  explorer.refine = config.refine;
  explorer.looks = config.looks;
  explorer.effort = static_cast<std::size_t>(config.effort);
  return explorer;
}

}  // namespace skein::agent
