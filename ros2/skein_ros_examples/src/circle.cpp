// A planner in C++: circles the nearest structure, looks at its middle, and comes home in time to deliver its pictures.
#include <cmath>

#include <skein_ros/planner.hpp>

class Circle : public skein_ros::Planner {
 public:
  explicit Circle(const rclcpp::NodeOptions& options) : Planner("circle", options) {}

 protected:
  void plan(const skein_ros::Inputs& in) override {
    if (!home_) home_ = in.p_WB;
    const auto& [x, y, z] = in.p_WB;
    const bool delivers = in.boxes.empty() || in.time_left_s.value_or(1e9) < kReturn_s;
    show_activity(delivers ? "delivers" : "circles");
    if (delivers) return fly_to({(*home_)[0], (*home_)[1], kHeight_m}, in.yaw);

    double middle_x = 0.0, middle_y = 0.0, radius_m = 0.0, nearest_m = 1e9;
    for (const skein_ros::Box& box : in.boxes) {
      double box_x = 0.0, box_y = 0.0, bottom_m = 1e9;
      for (const auto& vertex : box) {
        box_x += vertex[0] / 8.0;
        box_y += vertex[1] / 8.0;
        bottom_m = std::min(bottom_m, vertex[2]);
      }
      const double away_m = std::hypot(box_x - (*home_)[0], box_y - (*home_)[1]);
      if (bottom_m > kHeight_m || away_m > nearest_m) continue;
      nearest_m = away_m;
      middle_x = box_x;
      middle_y = box_y;
      radius_m = std::hypot(box[0][0] - box_x, box[0][1] - box_y) + kDistance_m;
    }
    const double angle = std::atan2(y - middle_y, x - middle_x) + kAhead_m / radius_m;
    fly_to({middle_x + radius_m * std::cos(angle), middle_y + radius_m * std::sin(angle), kHeight_m},
           std::atan2(middle_y - y, middle_x - x));
    aim(0.0, 0.0);
  }

 private:
  static constexpr double kReturn_s = 20.0, kHeight_m = 8.0, kDistance_m = 3.0, kAhead_m = 1.5;
  std::optional<skein_ros::Vector> home_;
};

SKEIN_ROS_MAIN(Circle)
