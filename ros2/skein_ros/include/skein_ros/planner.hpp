// A planner for Skein as a ROS 2 node: derive from Planner, decide in plan(), end with SKEIN_ROS_MAIN.
// Frames: W world (ENU), B body (x ahead, y left, z up).  Units: SI and radians.
// Threads: one. plan() and all callbacks run in the thread that spins the node.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/msg/pose.hpp>
#include <geometry_msgs/msg/twist.hpp>
#include <geometry_msgs/msg/twist_stamped.hpp>
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>

namespace skein_ros {

using Vector = std::array<double, 3>;

/// Another node in line of sight.
struct Neighbour {
  int node = 0;  ///< 0: the ground station; UAV i of the fleet: i + 1
  Vector p_W{};
};

/// A box around a part of the structure to be inspected.
struct Box {
  std::array<Vector, 8> vertices{};  ///< in W [m]

  Vector middle() const;
  double bottom() const;  ///< lowest z [m]
  double radius() const;  ///< of the upright cylinder around it [m]
};

/// Distance on the ground [m].
double ground_distance(const Vector& p_W, const Vector& q_W);

/// All that has been received up to a step.
struct Inputs {
  double time_s = 0.0;                ///< simulated
  std::optional<double> time_left_s;  ///< of the mission; nullopt before the first take-off
  Vector p_WB{};
  double yaw = 0.0;
  nav_msgs::msg::Odometry odometry;
  geometry_msgs::msg::TwistStamped gimbal;  ///< angles in linear, rates in angular: y pitch, z yaw
  std::vector<Box> boxes;
  std::vector<Neighbour> neighbours;
  sensor_msgs::msg::PointCloud2::ConstSharedPtr scan;        ///< of this step, points in W; else null
  sensor_msgs::msg::PointCloud2::ConstSharedPtr detections;  ///< all interest points that this UAV ever saw, or null
  std::vector<std::string> messages;                         ///< from others' say(), of this step

  bool sees_station() const;
};

class Planner : public rclcpp::Node {
 public:
  explicit Planner(const std::string& name, const rclcpp::NodeOptions& options = rclcpp::NodeOptions());
  ~Planner() override;

 protected:
  /// Decides. In the lock-step it is called once a step, 20 times a simulated second, when all that belongs to the step
  /// has been received; otherwise by a timer. An exception ends the process, and its text is in the log.
  virtual void plan(const Inputs& in) = 0;

  /// The vehicle flies to a place [m, in W], heading to `yaw`. Holds until the next command.
  void fly_to(const Vector& p_WB, double yaw);
  /// The same at a velocity [m/s, in W].
  void fly(const Vector& p_WB, const Vector& v_WB, double yaw);
  /// The gimbal turns to these angles, relative to the body: pitch down is positive, yaw to the left.
  void aim(double pitch, double yaw);
  /// The camera takes a picture now, and from now on only when it is told to.
  void take_picture();
  /// By radio, to all nodes in line of sight (/plan).
  void say(const std::string& text);
  /// For people who watch, at each change.
  void show_activity(const std::string& mode);

  const std::string& uav() const;

 private:
  struct Ends;
  template <class Message, class Callback>
  void hear(const std::string& topic, const rclcpp::QoS& qos, Callback callback);
  void hear_odometry(const nav_msgs::msg::Odometry& message);
  void step();
  std::unique_ptr<Ends> ends_;
};

/// The UAV that this program flies (SKEIN_UAV). @throws std::runtime_error without one.
std::string uav_of_environment();

/// Starts this program again with libskein_step.so, if the launcher has not loaded it. Before rclcpp::init().
void enter_step();

/// main() of a planner: spins a node made by `make` until the run is over. @returns the exit code
int run(int argc, char** argv, const std::function<std::shared_ptr<rclcpp::Node>()>& make);

template <class MyPlanner>
int run(int argc, char** argv) {
  return run(argc, argv, [] { return std::make_shared<MyPlanner>(rclcpp::NodeOptions()); });
}

}  // namespace skein_ros

/// The program of a planner with a constructor from rclcpp::NodeOptions.
#define SKEIN_ROS_MAIN(MyPlanner) \
  int main(int argc, char** argv) { return skein_ros::run<MyPlanner>(argc, argv); }
