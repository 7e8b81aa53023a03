// Planners that are ROS 2 nodes: `ros:PACKAGE/EXECUTABLE ARGUMENTS` as a shell command (docs/ros2.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skein::cli {

/// The command that starts the node in the lock-step: libskein_step.so of the package skein_ros is loaded before the
/// node's middleware, relative names are led to its UAV's, and its log goes to the results.
/// @param spec  a planner's. @returns nullopt for any other planner
/// @throws InputError when no ROS 2 workspace is set up (AMENT_PREFIX_PATH), or it has no such package or executable,
///   or no skein_ros
std::optional<std::string> ros_command(const std::string& spec);

/// For a shell: nodes find their certificate and permissions, which Skein names as an enclave of SROS 2 does.
/// @param keys  the folder of a program of a secured fleet, as a shell's word. It must be the shell's to write.
std::string enclave_command(const std::string& keys);

/// @param dds  vendor of a secured fleet.
/// @throws InputError when RMW_IMPLEMENTATION is not of that vendor
void check_secure_middleware(const std::string& dds);

/// For a shell: nodes look for a secured fleet where it is, on the loopback interface without multicast.
/// @param prefix  of the package skein_ros
std::string loopback_command(const std::filesystem::path& prefix);

/// Where the package skein_ros is; nullopt: not in AMENT_PREFIX_PATH.
std::optional<std::filesystem::path> skein_ros_prefix();

/// The settings of Fast DDS that this package has for nodes: without shared memory, of which a node that is killed
/// leaves some behind.
std::filesystem::path fastdds_profile(const std::filesystem::path& prefix);

}  // namespace skein::cli
