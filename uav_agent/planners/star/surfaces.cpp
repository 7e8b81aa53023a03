#include "uav_agent/planners/star/surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "uav_agent/maps/frontiers.hpp"
#include "uav_agent/planning/viewpoints.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

constexpr double kTilt = 0.8;          ///< tangent of the angle between a tilted view and the face's normal; chosen
constexpr double kEnoughShare = 0.85;  ///< the search ends at a view that sees this share of the patch; chosen
constexpr double kImageShare = 0.95;   ///< surface counts as seen within this share of the camera's half angles; chosen
constexpr double kNearShare = 0.75;    ///< the second distance to try, as a share of the stand-off; chosen
constexpr double kSpareM = 0.3;        ///< a viewpoint is at least the clearance plus this from its surface; chosen
constexpr double kRangeRatio = 1.5;    ///< a view sees at least this far, in units of the stand-off; chosen
constexpr std::size_t kMostTried = 4;  ///< views() tries at most this many patches, times `max_views`; chosen
constexpr int kMostFailures = 12;      ///< further failures do not make the wait before a retry longer; chosen

/// Whether no occupied cube covers the face; false at the grid's boundary.
bool exposed(const VoxelGrid& grid, Id id, int face) {
  const auto outside = grid.neighbour(id, face);
  return outside && grid.state(*outside) != VoxelState::occupied;
}

Vector3d surface_of(const VoxelGrid& grid, const WorldVoxels& voxels, Id id) {
  return voxels.surface_W(id).value_or(grid.centre_W(id));
}

}  // namespace

void StarSurfaces::mark_seen(const RigidBodyState& state, const GimbalState& gimbal, const WorldVoxels& voxels,
                             VoxelGrid& grid) const {
  const Vector3d p_WC = state.X_WB() * vehicle_.camera.p_BC;
  const double yaw = roll_pitch_yaw(state.q_WB.toRotationMatrix()).yaw + gimbal.yaw;
  const Matrix3d R_CW = (rotation_z(yaw) * rotation_y(gimbal.pitch)).transpose();
  const double half_width = 0.5 * kImageShare * vehicle_.camera.hfov_deg * kRadPerDeg;
  const double half_height = 0.5 * kImageShare * vehicle_.camera.vfov_deg * kRadPerDeg;
  const double range = config_.seen_ratio * config_.sharp_m;
  const auto here = grid.at(p_WC);
  if (!here) return;
  grid.around(*here, static_cast<int>(std::ceil(range / grid.voxel_m())), [&](Id id) {
    if (grid.state(id) != VoxelState::occupied) return;
    const Vector3d to_surface = surface_of(grid, voxels, id) - p_WC;
    const double distance = to_surface.norm();
    const Vector3d p_C = R_CW * to_surface;
    const bool in_image = p_C.x() > 0.0 && std::abs(std::atan2(p_C.y(), p_C.x())) < half_width &&
                          std::abs(std::atan2(p_C.z(), p_C.x())) < half_height;
    if (distance > range || !in_image || !grid.sees(p_WC, grid.centre_W(id))) return;
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      const double cosine = -to_surface.dot(grid.normal_W(face)) / distance;
      if (cosine > std::cos(config_.oblique) && exposed(grid, id, face)) grid.mark(id, face);
    }
  });
}

std::vector<StarSurfaces::Patch> StarSurfaces::patches(const VoxelGrid& grid, const std::vector<Id>& cubes,
                                                       const WorldVoxels& voxels, const Vector3d& p_W, Tick now) const {
  std::vector<Patch> result;
  for (int face = 0; face < VoxelGrid::kFaces; ++face) {
    std::vector<Id> open;
    for (const Id id : cubes) {
      if (grid.state(id) != VoxelState::occupied || grid.marked(id, face) || !exposed(grid, id, face)) continue;
      if (now >= failures_[VoxelGrid::kFaces * id + static_cast<Id>(face)].not_before) open.push_back(id);
    }
    for (const CubeCluster& cluster : clusters_of(grid, open, config_.patch_m, 1)) {
      Patch patch;
      patch.face = face;
      for (const Id id : cluster.cubes) {
        patch.faces.push_back(VoxelGrid::kFaces * id + static_cast<Id>(face));
        patch.surface_W.push_back(surface_of(grid, voxels, id));
        patch.middle_W += patch.surface_W.back() / static_cast<double>(cluster.cubes.size());
      }
      patch.distance = (patch.middle_W - p_W).norm();
      result.push_back(std::move(patch));
    }
  }
  std::ranges::stable_sort(result, {}, &Patch::distance);
  return result;
}

std::optional<StarView> StarSurfaces::best_view(const VoxelGrid& grid, const Patch& patch,
                                                const FreeSpace& space) const {
  constexpr double kTilts[][2] = {{0, 0}, {kTilt, 0}, {-kTilt, 0}, {0, kTilt}, {0, -kTilt}};
  const Vector3d out = grid.normal_W(patch.face);
  const Vector3d aside = grid.normal_W((patch.face + 2) % VoxelGrid::kFaces);
  const Vector3d above = grid.normal_W((patch.face + 4) % VoxelGrid::kFaces);  // geometry: each axis has two faces
  const double nearest = space.config().clearance_m + kSpareM;
  const double far = std::max(nearest, config_.standoff_ratio * config_.sharp_m);
  const double near = std::max(nearest, kNearShare * far);
  const ViewLimits limits{.range_m = std::max(config_.sharp_m, kRangeRatio * far),
                          .half_width = 0.5 * vehicle_.camera.hfov_deg * kRadPerDeg,
                          .half_height = 0.5 * vehicle_.camera.vfov_deg * kRadPerDeg};
  std::optional<StarView> best;
  std::size_t most = 0;
  for (const double standoff : {far, near}) {
    for (const auto& tilt : kTilts) {
      const Vector3d p = patch.middle_W + standoff * (out + tilt[0] * aside + tilt[1] * above).normalized();
      if (!space.free(p)) continue;
      const Vector3d to_middle = patch.middle_W - p;
      const double yaw = std::atan2(to_middle.y(), to_middle.x());
      const double pitch = std::atan2(-to_middle.z(), to_middle.head<2>().norm());
      const std::size_t seen = visible_targets(grid, p, yaw, pitch, patch.surface_W, limits).size();
      if (seen <= most) continue;
      most = seen;
      best = StarView{p, patch.middle_W, patch.faces};
      if (static_cast<double>(most) >= kEnoughShare * static_cast<double>(patch.faces.size())) return best;
    }
  }
  return best;
}

std::vector<StarView> StarSurfaces::views(const VoxelGrid& grid, const std::vector<Id>& cubes,
                                          const WorldVoxels& voxels, const FreeSpace& space, const Vector3d& p_W,
                                          Tick now) {
  std::vector<StarView> result;
  std::size_t tried = 0;
  for (const Patch& patch : patches(grid, cubes, voxels, p_W, now)) {
    if (result.size() == config_.max_views || tried++ == kMostTried * config_.max_views) break;
    if (auto view = best_view(grid, patch, space)) {
      result.push_back(std::move(*view));
    } else {
      for (const std::uint32_t face : patch.faces) failures_[face].not_before = now + ticks(config_.no_view_s);
    }
  }
  return result;
}

bool StarSurfaces::open(const VoxelGrid& grid, const StarView& view) {
  const auto left = std::ranges::count_if(view.faces, [&](std::uint32_t face) {
    return !grid.marked(face / VoxelGrid::kFaces, static_cast<int>(face % VoxelGrid::kFaces));
  });
  return 2 * static_cast<std::size_t>(left) > view.faces.size();
}

std::optional<Vector3d> StarSurfaces::nearest_open_W(const VoxelGrid& grid, const WorldVoxels& voxels,
                                                     const Vector3d& p_W) const {
  const auto here = grid.at(p_W);
  if (!here) return std::nullopt;
  std::optional<Vector3d> nearest;
  double least = config_.seen_ratio * config_.sharp_m;
  grid.around(*here, static_cast<int>(std::ceil(least / grid.voxel_m())), [&](Id id) {
    if (grid.state(id) != VoxelState::occupied) return;
    const Vector3d surface = surface_of(grid, voxels, id);
    const double distance = (surface - p_W).norm();
    if (distance >= least) return;
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      const bool faces_uav = (p_W - surface).dot(grid.normal_W(face)) > std::cos(config_.oblique) * distance;
      if (!faces_uav || grid.marked(id, face) || !exposed(grid, id, face)) continue;
      if (!grid.sees(p_W, grid.centre_W(id))) return;
      least = distance;
      nearest = surface;
      return;
    }
  });
  return nearest;
}

void StarSurfaces::failed(const StarView& view, Tick now) {
  for (const std::uint32_t face : view.faces) {
    Failure& failure = failures_[face];
    if (failure.count < kMostFailures) ++failure.count;
    failure.not_before = now + failure.count * ticks(config_.retry_s);
  }
}

}  // namespace skein::agent
