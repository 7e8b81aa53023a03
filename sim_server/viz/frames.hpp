// The frames of a run for ROS 2's tf: world -> <uav>/base_link -> <uav>/gimbal -> <uav>/camera, and world -> gcs.
// base_link is the body (FLU); gimbal and camera hang at the camera's place and look along their x axis, y left, z up
// (core/camera_quality.hpp). Pure.
//
// And those of one UAV for its own domain, from what it is told and no more: world -> <uav>/odom -> <uav>/base_link ->
// <uav>/gimbal -> <uav>/camera, and <uav>/base_link -> <uav>/lidar. These are the names of ROS's REP 105, where `world`
// has the place of `map`. odom stands still in world: a UAV knows no better than its odometry.
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

/// base_link in odom at the time of which the odometry tells; gimbal in base_link.
msg::TFMessage own_moving_frames(Tick tick, const UavConfig& uav, const UavView& view);
/// lidar in base_link: the optical centre of the LiDAR, whose servo stands so.
msg::TFMessage own_lidar_frame(const UavConfig& uav, const LidarServo& servo);
/// odom in world, camera in gimbal.
msg::TFMessage own_fixed_frames(const UavConfig& uav);

}  // namespace skein::sim::viz
