// Circles the nearest structure, looks at its middle, and comes home in time to deliver its pictures.
#include <cmath>
#include <skein_ros/planner.hpp>

class Circle : public skein_ros::Planner {
 public:
  explicit Circle(const rclcpp::NodeOptions& options) : Planner("circle", options) {}

 protected:
  void plan(const skein_ros::Inputs& in) override {
    if (!home_) home_ = skein_ros::Vector{in.p_WB[0], in.p_WB[1], 8.0};
    if (in.time_left_s.value_or(1e9) < 20.0) return fly_to(*home_, in.yaw);
    const skein_ros::Box* nearest = nullptr;
    for (const skein_ros::Box& box : in.boxes) {
      const bool nearer = !nearest || skein_ros::ground_distance(box.middle(), *home_) <
                                          skein_ros::ground_distance(nearest->middle(), *home_);
      if (box.bottom() < 8.0 && nearer) nearest = &box;
    }
    if (!nearest) return fly_to(*home_, in.yaw);
    const skein_ros::Vector middle = nearest->middle();
    const double radius = nearest->radius() + 3.0, dx = in.p_WB[0] - middle[0], dy = in.p_WB[1] - middle[1];
    const double angle = std::atan2(dy, dx) + 1.5 / radius;
    fly_to({middle[0] + radius * std::cos(angle), middle[1] + radius * std::sin(angle), 8.0}, std::atan2(-dy, -dx));
    aim(0.0, 0.0);
    show_activity("circles");
  }

 private:
  std::optional<skein_ros::Vector> home_;
};

SKEIN_ROS_MAIN(Circle)
