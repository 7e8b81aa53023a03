#include "sim_server/viz/frames.hpp"

#include "core/scoring/camera_quality.hpp"
#include "core/vehicle/lidar_geometry.hpp"
#include "idl/conversions.hpp"

namespace skein::sim::viz {
namespace {

void add_frame(msg::TFMessage& frames, Tick tick, const std::string& parent, const std::string& child,
               const Isometry3d& X_PC) {
  msg::TransformStamped frame;
  frame.header(to_header(tick, parent));
  frame.child_frame_id(child);
  frame.transform(to_transform(X_PC));
  frames.transforms().push_back(std::move(frame));
}

}  // namespace

msg::TFMessage moving_frames(Tick tick, const Scenario& scenario, std::span<const UavView> uavs) {
  msg::TFMessage frames;
  for (const UavIndex i : FirstUavs(uavs.size())) {
    const UavConfig& uav = scenario.fleet[i];
    const Isometry3d X_WB = uavs[i].state.X_WB();
    const Isometry3d X_WC = camera_state(uavs[i].state, uavs[i].gimbal, uav.vehicle.camera).X_WC;
    add_frame(frames, tick, "world", uav.name + "/base_link", X_WB);
    add_frame(frames, tick, uav.name + "/base_link", uav.name + "/gimbal", X_WB.inverse() * X_WC);
  }
  return frames;
}

msg::TFMessage fixed_frames(const Scenario& scenario) {
  msg::TFMessage frames;
  add_frame(frames, 0, "world", scenario.node_name(kStationNode),
            Isometry3d(Eigen::Translation3d(scenario.station_position)));
  for (const UavConfig& uav : scenario.fleet) {
    add_frame(frames, 0, uav.name + "/gimbal", uav.name + "/camera", Isometry3d::Identity());
  }
  return frames;
}

msg::TFMessage own_moving_frames(Tick tick, const UavConfig& uav, const UavView& view) {
  msg::TFMessage frames;
  const Isometry3d X_WB = view.told.X_WB();
  const Isometry3d X_WC = camera_state(view.told, view.gimbal, uav.vehicle.camera).X_WC;
  add_frame(frames, view.told_tick, uav.name + "/odom", uav.name + "/base_link", X_WB);
  add_frame(frames, tick, uav.name + "/base_link", uav.name + "/gimbal", X_WB.inverse() * X_WC);
  return frames;
}

msg::TFMessage own_lidar_frame(const UavConfig& uav, const LidarServo& servo) {
  msg::TFMessage frames;
  add_frame(frames, servo.tick, uav.name + "/base_link", uav.name + "/lidar",
            lidar_pose(Isometry3d::Identity(), servo.angle));
  return frames;
}

msg::TFMessage own_fixed_frames(const UavConfig& uav) {
  msg::TFMessage frames;
  add_frame(frames, 0, "world", uav.name + "/odom", Isometry3d::Identity());
  add_frame(frames, 0, uav.name + "/gimbal", uav.name + "/camera", Isometry3d::Identity());
  return frames;
}

}  // namespace skein::sim::viz
