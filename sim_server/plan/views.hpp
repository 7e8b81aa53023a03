// Places to take pictures from: what a UAV sees from each, judged by the production camera in the true scene.
// Frames: W world, B body, C camera.   Units: SI, radians.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene.hpp"
#include "sim_server/plan/team.hpp"

namespace skein::sim {

/// An interest point in a picture.
struct Sight {
  std::uint32_t point = 0;
  float q = 0.0F;
};

/// The body is at rest and level, its heading is the camera's, and the gimbal has the pitch.
struct View {
  Vector3d p_WB = Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0;
  std::size_t kind = 0;       ///< of UAV, in the team
  std::vector<Sight> sights;  ///< by point; only those that count by the rules
};

/// Views for all kinds of UAVs: at several distances from places all over the structure, on both sides, square to it
/// and tilted. The body keeps its kind's clearance. Of very many those are kept that show much or show what few others
/// do. Depends on nothing but its arguments, not on the number of threads.
std::vector<View> make_views(const Scenario& scenario, const Scene& scene, const Team& team, const PlanConfig& config);

/// The sum of what is better than `best`, which has a quality for each point. Pure.
double gain_of(const View& view, const std::vector<float>& best);

}  // namespace skein::sim
