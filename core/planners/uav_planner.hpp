// Which planner flies a UAV, in the words of --planner: the launcher starts it, and result.json names it.
// Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein {

/// What a shell command in the place of a planner begins with, and a ROS 2 node.
inline constexpr std::string_view kExec = "exec:";
inline constexpr std::string_view kRos = "ros:";

/// In the place of a planner: what was recorded of one is flown again.
inline constexpr const char* kRecorded = "recorded";

struct UavPlanner {
  std::string uav;   ///< or "gcs", the ground station
  std::string spec;  ///< "exec:CMD", or as uav_agent takes it: a name, with parameters if any ("hover:height_m=4")
  /// The program of NAME@AGENT, as written, or absolute once it was found; nullopt: the fleet's.
  std::optional<std::filesystem::path> agent = {};
};

/// As --planner takes it: NAME, NAME@AGENT, exec:CMD or ros:PACKAGE/EXECUTABLE.
std::string written(const UavPlanner& planner);

/// Whether a program of the user's takes the place of uav_agent: exec: or ros:.
bool is_command(std::string_view spec);

}  // namespace skein
