// Planners that are ROS 2 nodes: `ros:PACKAGE/EXECUTABLE ARGUMENTS` as a shell command (docs/how-to-ros2.md).
// Reads environment variables and looks for files.   Threads: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skein::cli {

/// The command that starts the node in the lock-step: it preloads libskein_step.so of the package skein_ros, puts
/// relative names into the UAV's namespace, and directs the node's log to the results.
/// @param spec  text of a planner. @returns nullopt if it is not a ros: planner
/// @throws InputError when no ROS 2 workspace is set up (AMENT_PREFIX_PATH), or it has no such package or executable,
///   or no skein_ros
std::optional<std::string> ros_command(const std::string& spec);

/// Shell command after which nodes find their certificate and permissions, whose files are named as in an SROS 2
/// enclave. @param keys  key folder of a program of a secured fleet, as a shell word; the shell must have write access
std::string enclave_command(const std::string& keys);

/// @param dds  DDS vendor of a secured fleet. @throws InputError when RMW_IMPLEMENTATION does not use that vendor
void check_secure_middleware(const std::string& dds);

/// Shell command after which nodes use only the loopback interface, without multicast, as a secured fleet does.
/// @param prefix  install prefix of the package skein_ros
std::string loopback_command(const std::filesystem::path& prefix);

/// Install prefix of the package skein_ros, the first with libskein_step.so; nullopt if AMENT_PREFIX_PATH has none.
std::optional<std::filesystem::path> skein_ros_prefix();

/// The Fast DDS profile for nodes in the package skein_ros. It disables shared memory, because a killed node leaves
/// segments behind. @param prefix  install prefix of skein_ros
std::filesystem::path fastdds_profile(const std::filesystem::path& prefix);

}  // namespace skein::cli
