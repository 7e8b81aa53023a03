// Parses the value of --planner: which planner flies which UAV, from which agent program, and what runs at the ground
// station.   Reads the environment and looks for files, if a planner is ros:.   Threads: any.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/planners/uav_planner.hpp"

namespace skein::cli {

/// The shell command of an exec: or ros: planner, which replaces uav_agent; nullopt for other planners.
/// @throws InputError as ros_command() (ros_command.hpp)
std::optional<std::string> exec_command(const std::string& spec);

/// The value of `gcs=` when nothing is to run at the ground station.
inline constexpr const char* kNoGround = "none";

struct Planners {
  std::vector<UavPlanner> uavs;  ///< fleet order
  /// The program at the ground station, if the user named one: a strategy, "exec:CMD" or "none".
  std::optional<UavPlanner> ground;
  UavPlanner fallback;  ///< the planner of the UAVs that were not named
};

/// Reads `NAME`, `UAV=NAME,...` or both (`patrol,jurong=hover`: patrol for all but jurong). A comma after a planner
/// with parameters continues its parameters unless a UAV's name and '=' follow: `jurong=kios:voxel=4,reserve=2`.
/// NAME may also be `exec:CMD` or `ros:PACKAGE/EXECUTABLE`. Such a command extends, including its commas, to the end or
/// to a comma that a UAV's name and '=' follow; so write the planner of all other UAVs before it:
/// `hover,jurong=exec:./mine --speed 3`. `gcs=NAME` names the program at the ground station.
/// `@AGENT` after NAME and its parameters, if any, gives the file of the agent program that has this planner:
/// `jurong=kios:voxel=4,reserve=2@team/agent`. The last '@' counts: parameters may contain '@' (then an AGENT must
/// follow, if only the stock uav_agent); the path of an AGENT may contain neither '@' nor a comma.
/// @param fleet names of all UAVs.
/// @throws InputError for an unknown UAV, an empty name, command or AGENT, a colon without parameters after it, or two
/// planners for one UAV.
Planners parse_planners(const std::string& text, const std::vector<std::string>& fleet);

/// The value of --planner for the same fleet with other planners for some UAVs; `text` itself if nothing changes.
/// @param text, fleet  as for parse_planners(). @param rewrite  gives the new planner for a UAV's present one
std::string planners_rewritten(const std::string& text, const std::vector<std::string>& fleet,
                               const std::function<UavPlanner(const UavPlanner& planner)>& rewrite);

/// Whether a planner's text has parameters, so that KEY=VALUE after a comma continues them.
bool has_parameters(const std::string& spec);

/// Position of the '=' in an item `KEY=...` if it precedes any parameters and AGENT; else npos.
std::size_t key_end(const std::string& item);

/// Gives the new name of an AGENT from its absolute path.
using NameOfAgent = std::function<std::string(const std::filesystem::path& agent)>;
/// The text with each AGENT renamed. From the first command on, the text stays as it is.
std::string with_agents_named(const std::string& text, const NameOfAgent& name_of);

/// The text as part of a folder's name: letters, digits, '.', '_', '-' and '@' stay, other characters become '_'; cut
/// to 100 characters.
std::string planner_label(const std::string& text);

}  // namespace skein::cli
