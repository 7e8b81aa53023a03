// The program at the ground station: collects where each UAV starts. 10 s after the last new report it closes the list,
// and sends it every second from then on. The list does not change, so that all UAVs compute the same teams.
#include <map>
#include <sstream>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

namespace baseline {

class Station : public rclcpp::Node {
 public:
  Station() : Node("baseline_gcs") {
    said_ = create_publisher<std_msgs::msg::String>("/plan", 64);
    heard_ = create_subscription<std_msgs::msg::String>("/plan" + std::string(get_namespace()), 64,
                                                        [this](const std_msgs::msg::String& m) { hear(m.data); });
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] { say(); });
  }

 private:
  /// "start NAME explorer|photographer X Y Z"
  void hear(const std::string& text) {
    std::istringstream words(text);
    std::string kind, name, rest;
    if (!(words >> kind >> name) || kind != "start" || is_closed() || starts_.count(name) > 0) return;
    std::getline(words, rest);
    starts_[name] = rest;
    newest_s_ = now().seconds();
  }

  bool is_closed() { return !starts_.empty() && now().seconds() > newest_s_ + 10.0; }

  void say() {
    if (!is_closed()) return;
    std_msgs::msg::String message;
    message.data = "fleet";
    for (const auto& [name, rest] : starts_) message.data += " " + name + rest;
    said_->publish(message);
  }

  std::map<std::string, std::string> starts_;  ///< of each name: role and position, as received
  double newest_s_ = 0.0;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr said_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr heard_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace baseline

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<baseline::Station>());
  rclcpp::shutdown();
}
