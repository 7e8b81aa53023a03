// The topics between server and node that the lock-step counts in a UAV's domain, by their ROS names. The authoritative
// table is Skein's core/topics.hpp; a test compares the two (tests/ros2). Needs no ROS.
#pragma once

#include <string>
#include <string_view>

namespace skein_ros {

enum class Way { to_node, from_node };

struct FleetTopic {
  const char* pattern;  ///< {id} stands for the UAV
  Way way;
  int depth;  ///< of the histories at both ends
  bool latched = false;
  bool explorers_only = false;
};

inline constexpr int kStateDepth = 8, kCommandDepth = 64, kRadioDepth = 256;
/// For arrivals on a radio topic: twenty UAVs and the ground station may send in one step.
inline constexpr int kArrivalDepth = 21 * kRadioDepth;

inline constexpr FleetTopic kFleetTopics[] = {
    {"/{id}/ground_truth/odometry", Way::to_node, kStateDepth},
    {"/{id}/gimbal", Way::to_node, kStateDepth},
    {"/{id}/cloud_inW", Way::to_node, kStateDepth, false, true},
    {"/{id}/lidar_servo", Way::to_node, kStateDepth, false, true},
    {"/{id}/slf_kf_cloud", Way::to_node, kStateDepth, false, true},
    {"/{id}/nbr_kf_cloud", Way::to_node, kCommandDepth},
    {"/{id}/nbr_odom_cloud", Way::to_node, kStateDepth},
    {"/{id}/detected_interest_points", Way::to_node, kStateDepth},
    {"/{id}/mission_duration_remained", Way::to_node, kStateDepth},
    {"/clock", Way::to_node, kStateDepth},
    {"/gcs/bounding_box_vertices", Way::to_node, 1, true},
    {"/{id}/command_rejected", Way::to_node, kCommandDepth},
    {"/{id}/battery", Way::to_node, kStateDepth},
    {"/{id}/wind", Way::to_node, kStateDepth},
    {"/{id}/radio_links", Way::to_node, kStateDepth},
    {"/{id}/activity", Way::from_node, kCommandDepth},
    {"/{id}/command/trajectory", Way::from_node, kCommandDepth},
    {"/{id}/command/gimbal", Way::from_node, kCommandDepth},
    {"/{id}/command/camera_trigger", Way::from_node, kCommandDepth},
    {"/{id}/command/trigger", Way::from_node, kCommandDepth},
};

/// The pattern with a UAV's name in it.
inline std::string named(std::string_view pattern, std::string_view id) {
  std::string name(pattern);
  constexpr std::string_view kPlace = "{id}";
  const auto at = name.find(kPlace);
  if (at != std::string::npos) name.replace(at, kPlace.size(), id);
  return name;
}

}  // namespace skein_ros
