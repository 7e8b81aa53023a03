// The frames of a run for ROS 2's tf: world -> <uav>/base_link -> <uav>/gimbal -> <uav>/camera, and world -> gcs.
// base_link is the body (FLU); gimbal and camera hang at the camera's place and look along their x axis, y left, z up
// (core/camera_quality.hpp). Pure.
#pragma once

#include <span>

#include "core/scenario.hpp"
#include "idl/type_names.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim::viz {

/// Those that move: base_link in world, gimbal in base_link.
msg::TFMessage moving_frames(Tick tick, const Scenario& scenario, std::span<const UavView> uavs);
/// Those that do not: gcs in world, camera in gimbal.
msg::TFMessage fixed_frames(const Scenario& scenario);

}  // namespace skein::sim::viz
