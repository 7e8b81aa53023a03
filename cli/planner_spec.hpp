// What the user wrote after --planner, taken apart: which planner flies which UAV, of which agent program, and what
// runs on the ground.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/planners/uav_planner.hpp"

namespace skein::cli {

/// The shell command that takes the place of uav_agent: of exec: or ros: (ros_command.hpp); nullopt for our planners.
std::optional<std::string> exec_command(const std::string& spec);

/// Flown by every UAV for which the user named none.
inline constexpr const char* kDefaultPlanner = "patrol";

/// In the place of a planner for `gcs`: nothing runs there.
inline constexpr const char* kNoGround = "none";

struct Planners {
  std::vector<UavPlanner> uavs;  ///< fleet order
  /// What the ground station runs, if the user said so: a strategy, "exec:CMD" or "none".
  std::optional<UavPlanner> ground;
  UavPlanner fallback;  ///< what flies the UAVs that were not named
};

/// Reads `NAME`, `UAV=NAME,...` or both (`patrol,jurong=hover`: patrol for all but jurong). A comma after a planner
/// with parameters continues its parameters unless a UAV's name and '=' follow: `jurong=kios:voxel=4,reserve=2`.
/// For NAME may stand `exec:CMD` or `ros:PACKAGE/EXECUTABLE`. It goes on, commas and all, to the end or a comma that a
/// UAV's name and '=' follow; so a planner for all others stands before it: `hover,jurong=exec:./mine --speed 3`.
/// `gcs=NAME` names the program at the ground station.
/// NAME, with its parameters if any, may be followed by `@AGENT`, the file of the agent program that knows it:
/// `jurong=kios:voxel=4,reserve=2@team/agent`. The last '@' is the one: a parameter may hold others (then there must be
/// an AGENT, the stock uav_agent if no other), the path of an AGENT none, and no comma.
/// @param fleet names of all UAVs.
/// @throws InputError for an unknown UAV, an empty name, command or AGENT, or two planners for one UAV.
Planners parse_planners(const std::string& text, const std::vector<std::string>& fleet);

/// The text of the same fleet with other planners for some UAVs.
/// @param text, fleet  as for parse_planners(). @param rewrite  what flies a UAV in the place of its planner
std::string planners_rewritten(const std::string& text, const std::vector<std::string>& fleet,
                               const std::function<UavPlanner(const UavPlanner& planner)>& rewrite);

/// Whether a planner's text has parameters, so that a piece KEY=VALUE after a comma goes on with them.
bool has_parameters(const std::string& spec);

/// The '=' of a piece `KEY=...`, where it stands before any parameters and before an AGENT; else npos.
std::size_t key_end(const std::string& item);

/// The text with another name for each AGENT, given its absolute path. From a command on it stays as it is.
using NameOfAgent = std::function<std::string(const std::filesystem::path& agent)>;
std::string with_agents_named(const std::string& text, const NameOfAgent& name_of);

/// The text made fit for a folder's name: letters, digits, '.', '_', '-' and '@' stay, all else becomes '_'; the first
/// 100 characters.
std::string planner_label(const std::string& text);

}  // namespace skein::cli
