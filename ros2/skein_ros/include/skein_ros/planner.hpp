// A planner for Skein as a ROS 2 node: derive from Planner, decide in plan(), end the file with SKEIN_ROS_MAIN.
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
  double radius() const;  ///< of the vertical cylinder around it [m]
};

/// Distance on the ground [m].
double ground_distance(const Vector& p_W, const Vector& q_W);

/// What the node has received up to a step.
struct Inputs {
  double time_s = 0.0;                ///< simulated
  std::optional<double> time_left_s;  ///< of the mission; nullopt before the fleet's first takeoff
  Vector p_WB{};
  double yaw = 0.0;
  nav_msgs::msg::Odometry odometry;
  geometry_msgs::msg::TwistStamped gimbal;  ///< angles in linear, rates in angular: y pitch, z yaw
  std::vector<Box> boxes;
  std::vector<Neighbour> neighbours;
  sensor_msgs::msg::PointCloud2::ConstSharedPtr scan;        ///< if one came in this step, else null; points in W
  sensor_msgs::msg::PointCloud2::ConstSharedPtr detections;  ///< all interest points seen so far by this UAV; or null
  std::vector<std::string> messages;  ///< received by radio since the last plan(), by others' say()

  bool sees_station() const;
};

class Planner : public rclcpp::Node {
 public:
  explicit Planner(const std::string& name, const rclcpp::NodeOptions& options = rclcpp::NodeOptions());
  ~Planner() override;

 protected:
  /// Decides what the UAV does. In the lock-step it is called once per step, 20 times per simulated second, when the
  /// node has received all messages of the step; otherwise every 50 ms by a timer. An exception ends the process; the
  /// log has its text.
  virtual void plan(const Inputs& in) = 0;

  /// Flies to a place [m, in W], with the heading `yaw`. The command holds until the next one.
  void fly_to(const Vector& p_WB, double yaw);
  /// The same, passing the place with a velocity [m/s, in W].
  void fly(const Vector& p_WB, const Vector& v_WB, double yaw);
  /// Turns the gimbal to angles relative to the body: positive pitch looks down, positive yaw turns left.
  void aim(double pitch, double yaw);
  /// Takes a picture now. After the first call, the camera takes no pictures by itself any more.
  void take_picture();
  /// Sends a text by radio to all nodes in line of sight (topic /plan).
  void say(const std::string& text);
  /// Reports the UAV's activity, for people who watch. Publishes only changes.
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

/// The UAV that this program flies (SKEIN_UAV). @throws std::runtime_error if the variable is not set
std::string uav_of_environment();

/// Restarts this program with libskein_step.so, if it flies a UAV and has not loaded that library. Call this before
/// rclcpp::init().
void enter_step();

/// main() of a planner: spins the node that `make` creates, until the run is over. @returns the exit code
int run(int argc, char** argv, const std::function<std::shared_ptr<rclcpp::Node>()>& make);

template <class MyPlanner>
int run(int argc, char** argv) {
  return run(argc, argv, [] { return std::make_shared<MyPlanner>(rclcpp::NodeOptions()); });
}

}  // namespace skein_ros

/// Defines main() for a planner whose constructor takes rclcpp::NodeOptions.
#define SKEIN_ROS_MAIN(MyPlanner) \
  int main(int argc, char** argv) { return skein_ros::run<MyPlanner>(argc, argv); }
