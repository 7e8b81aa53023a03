// Planners that are ROS 2 nodes: `ros:PACKAGE/EXECUTABLE ARGUMENTS` as a shell command (docs/ros2.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein::cli {

/// What such a planner begins with.
inline constexpr std::string_view kRos = "ros:";

/// The command that starts the node in the lock-step: libskein_step.so of the package skein_ros is loaded before the
/// node's middleware, relative names are led to its UAV's, and its log goes to the results.
/// @param spec  a planner's. @returns nullopt for any other planner
/// @throws InputError when no ROS 2 workspace is set up (AMENT_PREFIX_PATH), or it has no such package or executable,
///   or no skein_ros
std::optional<std::string> ros_command(const std::string& spec);

}  // namespace skein::cli
