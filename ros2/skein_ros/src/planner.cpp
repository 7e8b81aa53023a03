#include "skein_ros/planner.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <stdexcept>

#include <builtin_interfaces/msg/duration.hpp>
#include <sensor_msgs/msg/point_cloud.hpp>
#include <skein_msgs/msg/activity.hpp>
#include <skein_msgs/msg/bool_stamped.hpp>
#include <std_msgs/msg/string.hpp>
#include <trajectory_msgs/msg/multi_dof_joint_trajectory.hpp>

#include "skein_ros/step.h"
#include "step_library.hpp"

namespace skein_ros {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kDepth = 64;

double yaw_of(const geometry_msgs::msg::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

std::vector<Neighbour> neighbours_in(const sensor_msgs::msg::PointCloud2& cloud) {
  std::vector<Neighbour> result;
  if (cloud.point_step < 16) return result;
  for (std::size_t at = 0; at + cloud.point_step <= cloud.data.size(); at += cloud.point_step) {
    std::array<float, 4> point{};  // x, y, z, intensity
    std::memcpy(point.data(), cloud.data.data() + at, sizeof point);
    result.push_back({static_cast<int>(point[3]), {point[0], point[1], point[2]}});
  }
  return result;
}

std::vector<Box> boxes_in(const sensor_msgs::msg::PointCloud& cloud) {
  std::vector<Box> result(cloud.points.size() / 8);
  for (std::size_t i = 0; i < result.size() * 8; ++i) {
    result[i / 8].vertices[i % 8] = {cloud.points[i].x, cloud.points[i].y, cloud.points[i].z};
  }
  return result;
}

}  // namespace

Vector Box::middle() const {
  Vector middle{};
  for (const Vector& vertex : vertices) {
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] += vertex[i] / 8.0;
  }
  return middle;
}

double Box::bottom() const {
  double lowest = vertices[0][2];
  for (const Vector& vertex : vertices) lowest = std::min(lowest, vertex[2]);
  return lowest;
}

double Box::radius() const {
  double farthest = 0.0;
  for (const Vector& vertex : vertices) farthest = std::max(farthest, ground_distance(vertex, middle()));
  return farthest;
}

double ground_distance(const Vector& p_W, const Vector& q_W) { return std::hypot(p_W[0] - q_W[0], p_W[1] - q_W[1]); }

bool Inputs::sees_station() const {
  for (const Neighbour& neighbour : neighbours) {
    if (neighbour.node == 0) return true;
  }
  return false;
}

struct Planner::Ends {
  std::string uav = uav_of_environment();
  Inputs inputs;
  bool has_state = false;
  std::string mode;
  rclcpp::Publisher<trajectory_msgs::msg::MultiDOFJointTrajectory>::SharedPtr trajectory;
  rclcpp::Publisher<geometry_msgs::msg::Twist>::SharedPtr gimbal;
  rclcpp::Publisher<skein_msgs::msg::BoolStamped>::SharedPtr trigger;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr radio;
  rclcpp::Publisher<skein_msgs::msg::Activity>::SharedPtr activity;
  rclcpp::CallbackGroup::SharedPtr no_executor;
  std::vector<std::function<void()>> ears;  ///< one per topic: takes the messages that have arrived
  rclcpp::TimerBase::SharedPtr timer;
};

template <class Message, class Callback>
void Planner::hear(const std::string& topic, const rclcpp::QoS& qos, Callback callback) {
  rclcpp::SubscriptionOptions options;
  options.callback_group = ends_->no_executor;
  const auto subscription = create_subscription<Message>(topic, qos, callback, options);
  ends_->ears.push_back([subscription, callback] {
    rclcpp::MessageInfo info;
    for (auto message = std::make_shared<Message>(); subscription->take(*message, info);) {
      callback(message);
      message = std::make_shared<Message>();
    }
  });
}

Planner::Planner(const std::string& name, const rclcpp::NodeOptions& options)
    : Node(name, options), ends_(std::make_unique<Ends>()) {
  const std::string prefix = "/" + ends_->uav;
  const rclcpp::QoS qos(kDepth);
  ends_->trajectory =
      create_publisher<trajectory_msgs::msg::MultiDOFJointTrajectory>(prefix + "/command/trajectory", qos);
  ends_->gimbal = create_publisher<geometry_msgs::msg::Twist>(prefix + "/command/gimbal", qos);
  ends_->trigger = create_publisher<skein_msgs::msg::BoolStamped>(prefix + "/command/camera_trigger", qos);
  ends_->radio = create_publisher<std_msgs::msg::String>("/plan", qos);
  ends_->activity = create_publisher<skein_msgs::msg::Activity>(prefix + "/activity", qos);

  // An executor would search all its entities for each message: step() takes all messages at once.
  ends_->no_executor = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  hear<nav_msgs::msg::Odometry>(prefix + "/ground_truth/odometry", qos,
                                [this](nav_msgs::msg::Odometry::ConstSharedPtr m) { hear_odometry(*m); });
  Inputs& in = ends_->inputs;
  hear<geometry_msgs::msg::TwistStamped>(prefix + "/gimbal", qos,
                                         [&in](geometry_msgs::msg::TwistStamped::ConstSharedPtr m) { in.gimbal = *m; });
  hear<builtin_interfaces::msg::Duration>(
      prefix + "/mission_duration_remained", qos,
      [&in](builtin_interfaces::msg::Duration::ConstSharedPtr m) { in.time_left_s = rclcpp::Duration(*m).seconds(); });
  hear<sensor_msgs::msg::PointCloud>(
      "/gcs/bounding_box_vertices", rclcpp::QoS(1).transient_local(),
      [&in](sensor_msgs::msg::PointCloud::ConstSharedPtr m) { in.boxes = boxes_in(*m); });
  hear<sensor_msgs::msg::PointCloud2>(
      prefix + "/nbr_odom_cloud", qos,
      [&in](sensor_msgs::msg::PointCloud2::ConstSharedPtr m) { in.neighbours = neighbours_in(*m); });
  hear<sensor_msgs::msg::PointCloud2>(prefix + "/cloud_inW", qos,
                                      [&in](sensor_msgs::msg::PointCloud2::ConstSharedPtr m) { in.scan = m; });
  hear<sensor_msgs::msg::PointCloud2>(prefix + "/detected_interest_points", qos,
                                      [&in](sensor_msgs::msg::PointCloud2::ConstSharedPtr m) { in.detections = m; });
  hear<std_msgs::msg::String>("/plan/" + ends_->uav, qos,
                              [&in](std_msgs::msg::String::ConstSharedPtr m) { in.messages.push_back(m->data); });

  const auto before_answer = step_function<decltype(&skein_ros_before_answer)>("skein_ros_before_answer");
  if (before_answer != nullptr && is_member()) {
    before_answer([](void* self) { static_cast<Planner*>(self)->step(); }, this);
  } else {
    ends_->timer = create_wall_timer(50ms, [this] { step(); });
  }
}

Planner::~Planner() {
  const auto before_answer = step_function<decltype(&skein_ros_before_answer)>("skein_ros_before_answer");
  if (before_answer != nullptr) before_answer([](void*) {}, nullptr);
}

void Planner::hear_odometry(const nav_msgs::msg::Odometry& message) {
  Inputs& in = ends_->inputs;
  const auto& p = message.pose.pose.position;
  in.odometry = message;
  in.time_s = rclcpp::Time(message.header.stamp).seconds();
  in.p_WB = {p.x, p.y, p.z};
  in.yaw = yaw_of(message.pose.pose.orientation);
  ends_->has_state = true;
}

void Planner::step() {
  for (const auto& ear : ends_->ears) ear();
  if (!ends_->has_state) return;  // messages that have arrived so far wait for the first plan()
  try {
    plan(ends_->inputs);
  } catch (const std::exception& error) {
    fail("the planner threw: " + std::string(error.what()));
  }
  ends_->inputs.scan = nullptr;
  ends_->inputs.messages.clear();
}

void Planner::fly_to(const Vector& p_WB, double yaw) { fly(p_WB, {0.0, 0.0, 0.0}, yaw); }

void Planner::fly(const Vector& p_WB, const Vector& v_WB, double yaw) {
  geometry_msgs::msg::Transform transform;
  transform.translation.x = p_WB[0];
  transform.translation.y = p_WB[1];
  transform.translation.z = p_WB[2];
  transform.rotation.w = std::cos(yaw / 2.0);
  transform.rotation.z = std::sin(yaw / 2.0);
  geometry_msgs::msg::Twist velocity;
  velocity.linear.x = v_WB[0];
  velocity.linear.y = v_WB[1];
  velocity.linear.z = v_WB[2];
  trajectory_msgs::msg::MultiDOFJointTrajectory message;
  message.header.stamp = ends_->inputs.odometry.header.stamp;
  message.header.frame_id = "world";
  message.points.resize(1);
  message.points[0].transforms.push_back(transform);
  message.points[0].velocities.push_back(velocity);
  ends_->trajectory->publish(message);
}

void Planner::aim(double pitch, double yaw) {
  geometry_msgs::msg::Twist message;
  message.linear.x = 1.0;  // > 0: angles, not rates
  message.linear.y = pitch;
  message.linear.z = yaw;
  ends_->gimbal->publish(message);
}

void Planner::take_picture() {
  skein_msgs::msg::BoolStamped message;
  message.header.stamp = ends_->inputs.odometry.header.stamp;
  message.data = true;
  ends_->trigger->publish(message);
}

void Planner::say(const std::string& text) {
  std_msgs::msg::String message;
  message.data = text;
  ends_->radio->publish(message);
}

void Planner::show_activity(const std::string& mode) {
  if (mode == ends_->mode) return;
  ends_->mode = mode;
  skein_msgs::msg::Activity message;
  message.header.stamp = ends_->inputs.odometry.header.stamp;
  message.mode = mode;
  ends_->activity->publish(message);
}

const std::string& Planner::uav() const { return ends_->uav; }

}  // namespace skein_ros
