// The planner of a UAV or of the ground station, in the syntax of `--planner`. The launcher starts the program of each
// planner, and result.json names the planners.
// Pure; safe from any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein {

/// Prefixes of a spec that names a user's own program instead of a planner: a shell command ("exec:CMD"), or a ROS 2
/// node ("ros:PACKAGE/EXECUTABLE").
inline constexpr std::string_view kExec = "exec:";
inline constexpr std::string_view kRos = "ros:";

/// The planner of every UAV for which the user named none. python/skein/stepping/fleet.py has it, too.
inline constexpr const char* kDefaultPlanner = "flock";

/// Spec of a UAV whose agent does not run, because the run replays the agent's recorded output (`skein rerun`).
inline constexpr const char* kRecorded = "recorded";

struct UavPlanner {
  std::string uav;  ///< name of the UAV; "gcs": the ground station
  /// "exec:CMD", "ros:PACKAGE/EXECUTABLE", kRecorded, or what uav_agent accepts: a planner's name, with parameters if
  /// any ("hover:height_m=4").
  std::string spec;
  /// AGENT in NAME@AGENT, the file of an agent program: as the user wrote it, or its absolute path once the launcher
  /// has found it. nullopt: the agent program of the fleet (`--agent`, SKEIN_AGENT, or else uav_agent).
  std::optional<std::filesystem::path> agent = {};
};

/// @returns the planner in the syntax of `--planner`: NAME, NAME@AGENT, exec:CMD or ros:PACKAGE/EXECUTABLE.
std::string written(const UavPlanner& planner);

/// Whether `spec` begins with kExec or kRos: a user's own program then runs in place of uav_agent.
bool is_command(std::string_view spec);

}  // namespace skein
