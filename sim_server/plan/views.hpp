// Viewpoints, and the interest points that a UAV sees from each, as judged by the simulator's camera in the true scene.
// Frames: W world, B body, C camera.   Units: SI, radians.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scenario/scene.hpp"
#include "sim_server/plan/team.hpp"

namespace skein::sim {

/// An interest point in a picture.
struct Sight {
  std::uint32_t point = 0;
  float q = 0.0F;  ///< quality of the point in this picture
};

/// A viewpoint. The body is at rest and level and has the camera's heading; the gimbal has the camera's pitch.
struct View {
  Vector3d p_WB = Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0;
  std::size_t kind = 0;       ///< kind of UAV, by its index in the team
  std::vector<Sight> sights;  ///< one for each visible point that counts by the rules
};

/// Views for all kinds of UAVs: at several distances from places all over the structure, on both sides, perpendicular
/// to it and tilted. The body keeps its kind's clearance. If there are more than `most_views`, this keeps those that
/// show many points, or points that few others show. The result does not depend on the number of threads.
std::vector<View> make_views(const Scenario& scenario, const Scene& scene, const Team& team, const PlanConfig& config);

/// Sum over the view's points of the gain in quality over `best`. Pure. @param best  by point; empty: all 0.
double gain_of(const View& view, const std::vector<float>& best);

}  // namespace skein::sim
