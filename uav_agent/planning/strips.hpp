// Cuts the work into pieces and shares it out: each face of each box becomes parallel strips, as wide as what the
// camera sees of it, and each strip goes to one UAV of the fleet. All UAVs compute the same result from boxes and
// nominal starts alone, so they need no messages.
// Frame W.   Units: SI and radians.   Pure.
#pragma once

#include <vector>

#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

/// What the camera resolves, from its data sheet.
struct CameraReach {
  double sharp_distance_m = 7.36;  ///< d*: distance at which a wall, seen head-on, has the desired resolution
  double half_width_slope = 0.84;  ///< half of the width (and height) that the image shows, per metre of depth
  double half_height_slope = 0.58;
  double blur_speed_mps = 2.0;  ///< greatest sideways speed without blur at d*; in proportion to depth
};

/// d* = r_des f / (1000 pixel), with r_des in mm per pixel. Without blur: a point moves by at most one pixel during the
/// exposure.
CameraReach camera_reach(const CameraConfig& camera, double desired_mm_per_pixel);

enum class FaceKind { side, top, bottom };

/// A line on the face of a box. A UAV flies along it with the camera directed inwards.
struct Strip {
  std::size_t box = 0;
  FaceKind kind = FaceKind::side;
  Vector3d begin_W = Vector3d::Zero(), end_W = Vector3d::Zero();  ///< on the face
  Vector3d out_W = Vector3d::UnitX();                             ///< the face's outward normal
  Vector3d across_W = Vector3d::UnitY();                          ///< in the face, across the strip
  double half_width_m = 0.0;                                      ///< of the strip
  double inside_m = 0.0;                                          ///< how far the box reaches inwards from the face

  double length() const { return (end_W - begin_W).norm(); }
};

struct StripConfig {
  double standoff_ratio = 0.92;  ///< distance to the surface, in units of d*
  double overlap = 0.2;          ///< of neighbouring strips, as a share of the width that the camera sees
  double min_length_m = 2.0;     ///< smaller faces get no strip
  double max_length_m = 60.0;    ///< longer strips are cut in pieces, so that they can be shared out
  double lowest_m = 2.0;         ///< UAVs do not fly below this height
  bool top = true, bottom = true;
};

/// Strips of all faces, box by box. Side faces are cut along whichever axis takes less time.
std::vector<Strip> cut_into_strips(const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                                   const StripConfig& config);

/// One strip in a UAV's tour.
struct Visit {
  std::size_t strip = 0;
  bool reversed = false;  ///< flown from end to begin
};

/// Shares the strips out and orders them: the UAV that is done first takes the nearest remaining strip. Then 2-opt
/// shortens each tour by reversing parts of it.
/// @param p_W_start  where each UAV begins, in fleet order.
/// @param work_s     time that each strip takes.   @param transit_mps  speed between strips.
/// @param hands      by UAV: factor by which it works faster than work_s; empty: 1 for all.
/// @returns one tour for each UAV.
std::vector<std::vector<Visit>> share_strips(const std::vector<Strip>& strips, const std::vector<double>& work_s,
                                             const std::vector<Vector3d>& p_W_start, double transit_mps,
                                             const std::vector<double>& hands = {});

}  // namespace skein::agent
