// The frames of a run for ROS 2's tf: world -> <uav>/base_link -> <uav>/gimbal -> <uav>/camera, and world -> gcs.
// base_link is the body (FLU). The frames gimbal and camera have their origin at the camera; x is the direction of
// view, y points left, z up (core/scoring/camera_quality.hpp). Pure.
//
// In its own domain a UAV has frames with only the poses that it is told: world -> <uav>/odom -> <uav>/base_link ->
// <uav>/gimbal -> <uav>/camera, and <uav>/base_link -> <uav>/lidar. The names are those of ROS's REP 105, with `world`
// instead of `map`. odom coincides with world, because a UAV knows its position only by its odometry.
#pragma once

#include <span>

#include "core/scenario/scenario.hpp"
#include "idl/type_names.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim::viz {

/// Frames that move: base_link in world, gimbal in base_link.
msg::TFMessage moving_frames(Tick tick, const Scenario& scenario, std::span<const UavView> uavs);
/// Fixed frames: gcs in world, camera in gimbal.
msg::TFMessage fixed_frames(const Scenario& scenario);

/// A UAV's own frames that move: base_link in odom, stamped with the odometry's time; gimbal in base_link.
msg::TFMessage own_moving_frames(Tick tick, const UavConfig& uav, const UavView& view);
/// lidar in base_link: the optical centre of the LiDAR at this servo angle.
msg::TFMessage own_lidar_frame(const UavConfig& uav, const LidarServo& servo);
/// A UAV's own fixed frames: odom in world, camera in gimbal.
msg::TFMessage own_fixed_frames(const UavConfig& uav);

}  // namespace skein::sim::viz
