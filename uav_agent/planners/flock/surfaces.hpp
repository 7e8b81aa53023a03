// The targets to photograph, as far as this UAV knows: surface that no camera has looked at yet, on which interest
// points are expected, and known points, whose quality can still be improved.
//
// Surface consists of the exposed faces of occupied cubes in and near the boxes. A face that was in a picture with
// enough quality is marked in the grid: from then on, its points are known, and a face without points is done. Marks
// are sent with the map.
// Frames: W world, C camera.   Units: SI and radians.   Threads: one.   Effort: by the number of occupied cubes.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "core/scoring/camera_quality.hpp"
#include "uav_agent/maps/world_voxels.hpp"
#include "uav_agent/planners/flock/config.hpp"
#include "uav_agent/planners/flock/points.hpp"
#include "uav_agent/planners/flock/survey.hpp"

namespace skein::agent {

/// Something to photograph.
struct FlockTarget {
  Vector3d p_W = Vector3d::Zero(), n_W = Vector3d::UnitX();
  double points = 1.0;   ///< known or expected number of interest points; formula: a known point is one
  double have = 0.0;     ///< quality of the best picture so far, 0 to 1
  bool known = false;    ///< a detected point; otherwise surface
  std::uint32_t id = 0;  ///< unique among all targets of the flight
  /// Score that can still be gained [points].
  double open() const { return points * (1.0 - have); }
};

class FlockSurfaces {
 public:
  /// Targets farther than this, in units of d*, are not worth a picture. Chosen; measured with 1.6, too (decision 36).
  static constexpr double kPictureRatio = 2.1;

  /// @param sharp_m  d*.   @param agent, config  must outlive this.
  /// @param blind  this UAV knows no structure, and flies without a map: the faces of the boxes count as surface.
  FlockSurfaces(const FlockConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                double sharp_m, bool blind = false);
  bool blind() const { return blind_; }

  VoxelGrid& grid() { return grid_; }
  const VoxelGrid& grid() const { return grid_; }
  /// The part of the grid that this UAV reports to others: without boxes that only this UAV treats as structure.
  const VoxelGrid& told_grid() const { return nothing_told_ ? *nothing_told_ : grid_; }
  FlockSurvey& survey() { return survey_; }
  const FlockSurvey& survey() const { return survey_; }
  FlockPoints& points() { return points_; }
  const FlockPoints& points() const { return points_; }

  /// Takes over what changed on the map.   @param map  the same at each call.
  void look_at_map(const WorldMap& map);
  /// Notes the faces and points that the camera should see now.
  void look_at_picture(const Exposure& exposure, Tick now);
  /// Adds the camera's detections. Only a detection marks the faces that the camera looked at for the other UAVs:
  /// without one, the camera may have failed.   @param p_WC  position of the camera.
  /// @returns by how much they raise the sum of the points' best known qualities.
  double detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC);
  /// Call it when the camera turns out to have failed: takes back what was noted of pictures since the last detection.
  void forget_pictures();

  /// Numbers of the known points that a picture should show clearly, even if pose and map are somewhat wrong.
  std::vector<std::size_t> clear_points(const Exposure& exposure, Tick now) const;
  /// All known points, as targets of which there is no picture yet.
  std::vector<FlockTarget> known_points() const;

  /// Leaves this UAV's target out for two minutes: its camera could not be turned to it.
  void leave_out(const FlockTarget& target, Tick now);
  /// All targets that are worth another picture.
  std::vector<FlockTarget> targets(Tick now) const;

  /// Whether nothing on the map hides a point from a camera.
  bool sees(const Vector3d& p_WC, const Vector3d& p_W) const;
  /// Interest points per square metre, estimated from `density` and what was found on surface that was looked at.
  double density() const;
  /// Known exposed surface [m^2].
  double surface_m2() const { return voxel_area() * static_cast<double>(faces_); }

 private:
  using Id = VoxelGrid::Id;
  static constexpr Id kOutside = std::numeric_limits<Id>::max();  ///< format: for a cube that is not in a grid
  /// An occupied cube in or near the boxes. Arrays are by face.
  struct Cube {
    Id id = 0;
    std::array<Id, VoxelGrid::kFaces> next = {};              ///< the cube on the other side; or kOutside
    std::array<Id, VoxelGrid::kFaces> survey_cell = {};       ///< the survey's cell with the middle of `next`
    std::array<std::uint8_t, VoxelGrid::kFaces> tenths = {};  ///< tenths of the quality of the best picture so far
  };
  /// How a picture changed a face.
  struct Look {
    Id id = 0;
    int face = 0;
    std::uint8_t tenths = 0;  ///< Cube::tenths of the face before the picture
    bool shown = false;       ///< the picture was good enough: the UAV has looked at the face
  };
  double voxel_area() const { return grid_.voxel_m() * grid_.voxel_m(); }
  void list(Id id);
  bool exposed(const Cube& cube, int face) const;
  bool looked_at(Id id, int face) const { return grid_.marked(id, face) || (looked_here_[id] >> face & 1U) != 0; }
  void look_at_faces(const Exposure& exposure);
  Vector3d surface_W(Id id) const;

  const FlockConfig& config_;
  const AgentConfig& agent_;
  const double sharp_m_;
  const bool blind_;
  VoxelGrid grid_;
  std::optional<VoxelGrid> nothing_told_;  ///< an empty grid, if this UAV is blind and others may not be
  WorldVoxels voxels_;
  FlockSurvey survey_;
  FlockPoints points_;
  std::vector<Cube> occupied_;              ///< in the order of discovery
  std::vector<std::uint32_t> listed_;       ///< by cube: its place in occupied_, from 1; 0: it is not there
  std::vector<std::uint8_t> in_site_;       ///< by cube: it is in or near a box
  std::vector<std::uint8_t> looked_here_;   ///< by cube: a bit for each face that this UAV has looked at
  std::vector<Look> not_told_;              ///< since the last detection, in order
  std::map<std::uint32_t, Tick> left_out_;  ///< by FlockTarget::id: until when
  std::size_t faces_ = 0, looked_ = 0;      ///< number of exposed faces; of those that a camera looked at
};

}  // namespace skein::agent
