#include "vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace baseline {
namespace {

constexpr double kPeriodS = 0.05, kHalfTurn = 3.14159265358979323846;
constexpr double kMostPitch = 80.0 / 180.0 * kHalfTurn;
constexpr double kBrakesMps2 = 1.2, kSlowMps = 0.5;
constexpr int kDepth = 64;

double wrapped(double angle) { return std::remainder(angle, 2.0 * kHalfTurn); }

}  // namespace

Vehicle::Vehicle(rclcpp::Node& node)
    : node_(node),
      speed_mps_(node.declare_parameter("speed_mps", 2.0)),
      aim_rad_(node.declare_parameter("aim_rad", 0.3)),
      dwell_s_(node.declare_parameter("dwell_s", 0.2)),
      cell_s_(node.declare_parameter("cell_s", 3.0)) {
  trajectory_ = node.create_publisher<trajectory_msgs::msg::MultiDOFJointTrajectory>("command/trajectory", kDepth);
  gimbal_ = node.create_publisher<geometry_msgs::msg::Twist>("command/gimbal", kDepth);
  heard_.push_back(node.create_subscription<nav_msgs::msg::Odometry>(
      "ground_truth/odometry", kDepth, [this](const nav_msgs::msg::Odometry& m) {
        const auto& p = m.pose.pose.position;
        const auto& q = m.pose.pose.orientation;
        p_WB_ = {p.x, p.y, p.z};
        yaw_ = std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
        if (!has_state_) place_ = p_WB_, yaw_goal_ = yaw_;
        has_state_ = true;
      }));
  heard_.push_back(node.create_subscription<geometry_msgs::msg::TwistStamped>(
      "gimbal", kDepth, [this](const geometry_msgs::msg::TwistStamped& m) {
        gimbal_pitch_ = m.twist.linear.y;
        gimbal_yaw_ = m.twist.linear.z;
      }));
  heard_.push_back(node.create_subscription<builtin_interfaces::msg::Duration>(
      "mission_duration_remained", kDepth,
      [this](const builtin_interfaces::msg::Duration& m) { time_left_s_ = rclcpp::Duration(m).seconds(); }));
}

void Vehicle::follow(const std::vector<Cell>& way) {
  way_.assign(way.begin(), way.end());
  faces_.clear();
}

bool Vehicle::has_arrived() const { return way_.empty() && (p_WB_ - place_).norm() < 0.4; }

void Vehicle::look_around(const Grid& grid) {
  const Cell here = cell_at(place_);
  for (const Cell& cell : neighbours_of(here)) {
    if (grid.is_occupied(cell)) faces_.push_back((middle_of(cell) - middle_of(here)).normalized());
  }
  cell_until_s_ = node_.now().seconds() + cell_s_;
}

/// At 2 m/s a vehicle overshoots by 0.9 m if its setpoint stops at once. So the setpoint slows down before the way ends
/// or turns.
double Vehicle::pace_mps() const {
  double straight_m = 0.0;
  Vector at = place_, ahead = Vector::Zero();
  for (const Cell& cell : way_) {
    const Vector step = middle_of(cell) - at;
    if (straight_m > 0.0 && step.normalized().dot(ahead) < 0.99) break;
    straight_m += step.norm();
    ahead = step.normalized();
    at = middle_of(cell);
  }
  return std::clamp(std::sqrt(2.0 * kBrakesMps2 * straight_m), kSlowMps, speed_mps_);
}

void Vehicle::advance(double distance_m) {
  while (!way_.empty() && distance_m > 0.0) {
    const Vector left = middle_of(way_.front()) - place_;
    const double step = std::min(distance_m, left.norm());
    if (left.norm() > 1e-9) place_ += step * left.normalized();
    distance_m -= step;
    if ((middle_of(way_.front()) - place_).norm() < 1e-6) way_.pop_front();
  }
}

void Vehicle::look() {
  const double now_s = node_.now().seconds();
  if (faces_.empty() || now_s > cell_until_s_) return faces_.clear();
  const Vector& face = faces_.front();
  gimbal_pitch_goal_ = std::clamp(-std::asin(face.z()), -kMostPitch, kMostPitch);  // down is positive
  if (std::abs(face.z()) < 0.5) {
    // The body faces east, and the gimbal turns by less than 90 degrees to either side: the body turns to faces behind.
    const double yaw = std::atan2(face.y(), face.x());
    const bool behind = std::abs(yaw) > kHalfTurn / 2.0 - 0.1;
    yaw_goal_ = behind ? yaw : 0.0;
    gimbal_yaw_goal_ = behind ? 0.0 : yaw;
  }
  const double error =
      std::hypot(wrapped(yaw_goal_ + gimbal_yaw_goal_ - yaw_ - gimbal_yaw_), gimbal_pitch_goal_ - gimbal_pitch_);
  if (error > aim_rad_) {
    aimed_since_s_ = -1.0;
  } else if (aimed_since_s_ < 0.0) {
    aimed_since_s_ = now_s;
  } else if (now_s - aimed_since_s_ >= dwell_s_) {
    faces_.pop_front();
    aimed_since_s_ = -1.0;
  }
}

void Vehicle::fly(const std::function<bool(const Cell&)>& barred) {
  const Cell here = cell_at(place_);
  if (!way_.empty() && !(way_.front() == here) && barred(way_.front())) stop();
  const Vector before = place_;
  // The setpoint waits for a vehicle that is held back.
  if ((p_WB_ - place_).norm() < kCellM / 2.0) advance(pace_mps() * kPeriodS);
  look();

  const Vector v_W = (place_ - before) / kPeriodS;
  trajectory_msgs::msg::MultiDOFJointTrajectory command;
  command.header.stamp = node_.now();
  command.header.frame_id = "world";
  command.points.resize(1);
  geometry_msgs::msg::Transform pose;
  pose.translation.x = place_.x(), pose.translation.y = place_.y(), pose.translation.z = place_.z();
  pose.rotation.w = std::cos(yaw_goal_ / 2.0), pose.rotation.z = std::sin(yaw_goal_ / 2.0);
  geometry_msgs::msg::Twist velocity;
  velocity.linear.x = v_W.x(), velocity.linear.y = v_W.y(), velocity.linear.z = v_W.z();
  command.points[0].transforms.push_back(pose);
  command.points[0].velocities.push_back(velocity);
  trajectory_->publish(command);

  geometry_msgs::msg::Twist aim;
  aim.linear.x = 1.0;  // > 0: angles, not rates
  aim.linear.y = gimbal_pitch_goal_;
  aim.linear.z = gimbal_yaw_goal_;
  gimbal_->publish(aim);
}

}  // namespace baseline
