// Divides the work among the UAVs of a fleet: cuts each face of each box into parallel strips, about as wide as a
// picture of the face, and assigns each strip to one UAV or team. All UAVs compute the same result from the boxes, the
// nominal starts and the vehicles' data sheets, without messages.
// Frame W.   Units: SI and radians.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

/// What a camera resolves, computed from its data sheet and the desired resolution r_des.
struct CameraReach {
  double sharp_distance_m = 7.36;   ///< d*: a picture of a perpendicular wall has that resolution from here; sensor
  double half_width_slope = 0.84;   ///< half of the width of a picture, per metre of distance; sensor
  double half_height_slope = 0.58;  ///< the same for its height; sensor
  double blur_speed_mps = 2.0;      ///< maximum sideways speed without blur at d*; proportional to the distance; sensor
};

/// d* = r_des f / (1000 p), with r_des in mm per pixel, the focal length f and the pixel size p. A picture is without
/// blur if a point moves by at most one pixel during the exposure.
CameraReach camera_reach(const CameraConfig& camera, double desired_mm_per_pixel);

enum class FaceKind { side, top, bottom };

/// A line on the face of a box. A UAV flies along it, at a distance, with the camera towards the face.
struct Strip {
  std::size_t box = 0;
  FaceKind kind = FaceKind::side;
  Vector3d begin_W = Vector3d::Zero(), end_W = Vector3d::Zero();  ///< on the face
  Vector3d out_W = Vector3d::UnitX();                             ///< the face's outward normal
  Vector3d across_W = Vector3d::UnitY();                          ///< unit vector in the face, across the strip
  double half_width_m = 0.0;                                      ///< of the strip
  double inside_m = 0.0;                                          ///< depth of the box behind the face

  double length() const { return (end_W - begin_W).norm(); }
};

struct StripConfig {
  double standoff_ratio = 0.92;  ///< distance to the surface, in units of d*; chosen
  double overlap = 0.2;          ///< of neighbouring strips, as a share of a picture's extent across the strip; chosen
  double min_length_m = 2.0;     ///< a face with a shorter edge gets no strip; chosen
  double max_length_m = 60.0;    ///< longer strips are cut into pieces, which different UAVs can take; chosen
  /// A bottom face gets strips only if a UAV that photographs it from below is at least 3 m above this height.
  /// Chosen.
  double lowest_m = 2.0;
  bool top = true, bottom = true;  ///< whether top and bottom faces get strips
};

/// Strips of all faces, box by box. Strips run along whichever axis of their face takes less time.
std::vector<Strip> cut_into_strips(const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                                   const StripConfig& config);

/// One strip in a UAV's tour.
struct Visit {
  std::size_t strip = 0;
  bool reversed = false;  ///< flown from end to begin
};

/// Assigns the strips to tours, and orders them: the tour that would end first gets the remaining strip that is nearest
/// to its end. Then 2-opt shortens each tour by reversing parts of it. Each tour belongs to one UAV or team.
/// @param p_W_start  where each tour begins.
/// @param work_s     time that one UAV needs for each strip.   @param transit_mps  speed between strips.
/// @param team_size  by tour: number of UAVs that share it, by which its time is divided; empty: 1 for all.
/// @returns one tour for each start.
std::vector<std::vector<Visit>> share_strips(const std::vector<Strip>& strips, const std::vector<double>& work_s,
                                             const std::vector<Vector3d>& p_W_start, double transit_mps,
                                             const std::vector<double>& team_size = {});

}  // namespace skein::agent
