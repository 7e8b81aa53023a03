// The UAV's own topics: receives its state, flies it along cells, and turns the camera to the structure beside them.
// Frames: W world (ENU), B body (x ahead, y left, z up).   Units: SI, radians.   Thread: that of the node.
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include <builtin_interfaces/msg/duration.hpp>
#include <geometry_msgs/msg/twist.hpp>
#include <geometry_msgs/msg/twist_stamped.hpp>
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <trajectory_msgs/msg/multi_dof_joint_trajectory.hpp>

#include "grid.hpp"

namespace baseline {

class Vehicle {
 public:
  /// Reads its parameters: speed_mps, aim_rad, dwell_s, cell_s. @param node  must outlive this.
  explicit Vehicle(rclcpp::Node& node);

  bool has_state() const { return has_state_; }
  const Vector& p_WB() const { return p_WB_; }
  /// The cell of the setpoint, in which a new way begins.
  Cell cell() const { return cell_at(place_); }
  /// Time that is left of the mission [s]; nullopt before the fleet's first takeoff.
  const std::optional<double>& time_left_s() const { return time_left_s_; }
  double speed_mps() const { return speed_mps_; }

  /// From now on flies along these cells, from middle to middle.
  void follow(const std::vector<Cell>& way);
  /// Flies to the middle of cell().
  void stop() { follow({cell()}); }
  bool has_arrived() const;
  const std::deque<Cell>& way() const { return way_; }
  /// Turns the camera to the structure beside cell(), face by face. Call this only after has_arrived().
  void look_around(const Grid& grid);
  bool has_looked() const { return faces_.empty(); }

  /// One step of 50 ms: commands vehicle and gimbal. Stops before a cell that is `barred`.
  void fly(const std::function<bool(const Cell&)>& barred);

 private:
  double pace_mps() const;
  void advance(double distance_m);
  void look();

  rclcpp::Node& node_;
  double speed_mps_, aim_rad_, dwell_s_, cell_s_;
  bool has_state_ = false;
  Vector p_WB_ = Vector::Zero();
  double yaw_ = 0.0, gimbal_pitch_ = 0.0, gimbal_yaw_ = 0.0;
  std::optional<double> time_left_s_;
  Vector place_ = Vector::Zero();  ///< the setpoint; moves along way_
  std::deque<Cell> way_;
  std::deque<Vector> faces_;  ///< directions in W in which it has yet to look
  double cell_until_s_ = 0.0, aimed_since_s_ = -1.0;
  double yaw_goal_ = 0.0, gimbal_pitch_goal_ = 0.0, gimbal_yaw_goal_ = 0.0;
  rclcpp::Publisher<trajectory_msgs::msg::MultiDOFJointTrajectory>::SharedPtr trajectory_;
  rclcpp::Publisher<geometry_msgs::msg::Twist>::SharedPtr gimbal_;
  std::vector<rclcpp::SubscriptionBase::SharedPtr> heard_;
};

}  // namespace baseline
