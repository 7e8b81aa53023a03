// An ordinary rclcpp node that subscribes to the topics of a bag while it is played. Prints the stamps of each topic
// when the player has ended.
//   listen FILE      writes FILE once its subscriptions exist, and to FILE.heard a line "TOPIC NANOSECONDS" per message
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include <geometry_msgs/msg/twist_stamped.hpp>
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/point_cloud.hpp>
#include <tf2_msgs/msg/tf_message.hpp>
#include <trajectory_msgs/msg/multi_dof_joint_trajectory.hpp>

namespace {

class Listener : public rclcpp::Node {
 public:
  explicit Listener(const std::string& file) : Node("listen"), heard_(file + ".heard") {
    // The strictest QoS that still matches: a VOLATILE publisher would not match a TRANSIENT_LOCAL subscription.
    const rclcpp::QoS moving = rclcpp::QoS(1000).reliable(), latched = rclcpp::QoS(1).reliable().transient_local();
    hear<nav_msgs::msg::Odometry>("/jurong/ground_truth/odometry", moving);
    hear<geometry_msgs::msg::TwistStamped>("/jurong/gimbal", moving);
    hear<trajectory_msgs::msg::MultiDOFJointTrajectory>("/jurong/command/trajectory", moving);
    hear<sensor_msgs::msg::PointCloud>("/gcs/bounding_box_vertices", latched);
    const auto first = [](const tf2_msgs::msg::TFMessage& m) { return m.transforms.at(0).header.stamp; };
    hear_stamp<tf2_msgs::msg::TFMessage>("/tf", moving, first);
    hear_stamp<tf2_msgs::msg::TFMessage>("/tf_static", latched, first);
  }

 private:
  template <class Message, class Stamp>
  void hear_stamp(const std::string& topic, const rclcpp::QoS& qos, Stamp stamp) {
    subscriptions_.push_back(create_subscription<Message>(topic, qos, [this, topic, stamp](const Message& message) {
      heard_ << topic << " " << rclcpp::Time(stamp(message)).nanoseconds() << std::endl;
    }));
  }
  template <class Message>
  void hear(const std::string& topic, const rclcpp::QoS& qos) {
    hear_stamp<Message>(topic, qos, [](const Message& message) { return message.header.stamp; });
  }

  std::ofstream heard_;
  std::vector<rclcpp::SubscriptionBase::SharedPtr> subscriptions_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::string file = argv[1];
  const auto node = std::make_shared<Listener>(file);
  std::ofstream ready(file);
  bool begun = false;
  while (rclcpp::ok() && (!begun || node->count_publishers("/tf") > 0)) {
    begun = begun || node->count_publishers("/tf") > 0;
    rclcpp::spin_some(node);
    rclcpp::sleep_for(std::chrono::milliseconds(2));
  }
  rclcpp::spin_some(node);
  rclcpp::shutdown();
}
