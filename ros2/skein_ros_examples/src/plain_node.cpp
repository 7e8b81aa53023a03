// A node that knows nothing of Skein, as a component. It uses relative topic names, which a namespace resolves to those
// of its UAV (--ros-args -r __ns:=/jurong), a wall timer, the node's clock, and a topic of its own.
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <trajectory_msgs/msg/multi_dof_joint_trajectory.hpp>

namespace plain {

class Climber : public rclcpp::Node {
 public:
  explicit Climber(const rclcpp::NodeOptions& options);

 private:
  void tick() {
    if (!start_) return;
    // Climbs 0.5 m per second of the node's clock, and 1 mm for each message that it has received from itself.
    const double climbed_m = std::min(height_m_, 0.5 * now().seconds() + 0.001 * heard_count_);
    trajectory_msgs::msg::MultiDOFJointTrajectory command;
    command.header.stamp = now();
    command.header.frame_id = "world";
    command.points.resize(1);
    command.points[0].transforms.resize(1);
    auto& goal = command.points[0].transforms[0];
    goal.translation.x = start_->x;
    goal.translation.y = start_->y;
    goal.translation.z = start_->z + climbed_m;
    commands_->publish(command);
    goals_->publish(std_msgs::msg::String());
  }

  double height_m_ = 0.0;
  int heard_count_ = 0;
  std::optional<geometry_msgs::msg::Point> start_;
  rclcpp::Publisher<trajectory_msgs::msg::MultiDOFJointTrajectory>::SharedPtr commands_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr goals_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr heard_;
  rclcpp::Subscription<nav_msgs::msg::Odometry>::SharedPtr odometry_;
  rclcpp::TimerBase::SharedPtr timer_;
};

Climber::Climber(const rclcpp::NodeOptions& options) : Node("climber", options) {
  height_m_ = declare_parameter("height_m", 3.0);
  commands_ = create_publisher<trajectory_msgs::msg::MultiDOFJointTrajectory>("command/trajectory", 10);
  goals_ = create_publisher<std_msgs::msg::String>("goals", 10);
  heard_ = create_subscription<std_msgs::msg::String>(
      "goals", 10, [this](std_msgs::msg::String::ConstSharedPtr) { ++heard_count_; });
  odometry_ = create_subscription<nav_msgs::msg::Odometry>("ground_truth/odometry", rclcpp::SensorDataQoS(),
                                                           [this](nav_msgs::msg::Odometry::ConstSharedPtr m) {
                                                             if (!start_) start_ = m->pose.pose.position;
                                                           });
  timer_ = create_wall_timer(std::chrono::milliseconds(130), [this] { tick(); });
}

}  // namespace plain
