// What there is to photograph, as far as this UAV knows: surface that no camera has looked at yet, on which interest
// points are expected, and known points, by how much better they can still be photographed.
//
// Surface is the exposed faces of occupied cubes in or about the boxes. A face that was in a picture with some quality
// is marked in the grid: its points are known from then on, and an empty one is done. Marks travel with the map.
// Frames: W world, C camera.   Units: SI and radians.   Threads: one.   Effort: cubes that are occupied.
#pragma once

#include <vector>

#include "core/camera_quality.hpp"
#include "uav_agent/maps/world_voxels.hpp"
#include "uav_agent/planners/flock/config.hpp"
#include "uav_agent/planners/flock/points.hpp"
#include "uav_agent/planners/flock/survey.hpp"

namespace skein::agent {

/// Something to photograph.
struct FlockTarget {
  Vector3d p_W = Vector3d::Zero(), n_W = Vector3d::UnitX();
  double points = 1.0;  ///< how many interest points that is, or is expected to be
  double have = 0.0;    ///< the quality with which it was photographed
  bool known = false;   ///< a point that was found; else surface
  double open() const { return points * (1.0 - have); }
};

class FlockSurfaces {
 public:
  /// @param sharp_m  d*.   @param agent, config  must outlive this.
  FlockSurfaces(const FlockConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                double sharp_m);

  VoxelGrid& grid() { return grid_; }
  const VoxelGrid& grid() const { return grid_; }
  FlockSurvey& survey() { return survey_; }
  const FlockSurvey& survey() const { return survey_; }
  FlockPoints& points() { return points_; }
  const FlockPoints& points() const { return points_; }

  void look_at_map(const WorldMap& map);
  /// Takes in what the camera should see now.
  void look_at_picture(const Exposure& exposure, Tick now);
  /// What the camera really saw. Only then this UAV tells others which surface it looked at: a camera may have failed.
  void detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC);

  /// All that is worth another picture.
  std::vector<FlockTarget> targets(Tick now) const;

  /// Whether nothing known hides a point from a camera.
  bool sees(const Vector3d& p_WC, const Vector3d& p_W) const;
  /// Interest points on a square metre, by what was found on surface that was looked at.
  double density() const;
  /// Exposed surface that is known of [m^2].
  double surface_m2() const { return voxel_area() * static_cast<double>(faces_); }

 private:
  using Id = VoxelGrid::Id;
  double voxel_area() const { return grid_.voxel_m() * grid_.voxel_m(); }
  bool exposed(Id id, int face) const;
  bool looked_at(Id id, int face) const { return grid_.marked(id, face) || (looked_here_[id] >> face & 1U) != 0; }
  void look_at_faces(const Exposure& exposure);
  Vector3d surface_W(Id id) const;

  const FlockConfig& config_;
  const AgentConfig& agent_;
  const double sharp_m_;
  VoxelGrid grid_;
  WorldVoxels voxels_;
  FlockSurvey survey_;
  FlockPoints points_;
  std::vector<Id> occupied_;                  ///< cubes in or about the boxes, in the order in which they became so
  std::vector<std::uint8_t> listed_;          ///< by cube: it is among them
  std::vector<std::uint8_t> in_site_;         ///< by cube: it is in or about a box
  std::vector<std::uint8_t> looked_here_;     ///< by cube: a bit for each face that this UAV has looked at
  std::vector<std::pair<Id, int>> not_told_;  ///< of those, since it last detected anything
  std::size_t faces_ = 0, looked_ = 0;
};

}  // namespace skein::agent
