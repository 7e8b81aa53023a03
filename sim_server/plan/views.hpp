// Places to take pictures from, and what a UAV sees from each: the simulator's camera judges this in the true scene.
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

/// The body is at rest and level and has the camera's heading; the gimbal has the camera's pitch.
struct View {
  Vector3d p_WB = Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0;
  std::size_t kind = 0;       ///< kind of UAV, by its index in the team
  std::vector<Sight> sights;  ///< one for each point that counts by the rules
};

/// Views for all kinds of UAVs: at several distances from places all over the structure, on both sides, perpendicular
/// to it and tilted. The body keeps its kind's clearance. Of very many views, this keeps those that show much, or what
/// few others show. The result depends on nothing but the arguments, and not on the number of threads.
std::vector<View> make_views(const Scenario& scenario, const Scene& scene, const Team& team, const PlanConfig& config);

/// The sum of the qualities beyond those in `best`, which has a quality for each point. Pure.
double gain_of(const View& view, const std::vector<float>& best);

}  // namespace skein::sim
