// What the user wrote after --planner, taken apart: which planner flies which UAV, and what runs on the ground.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

struct UavPlanner {
  std::string uav;
  std::string spec;  ///< "exec:CMD", or as uav_agent takes it: a name, with parameters if any ("hover:height_m=4")
};

/// CMD of "exec:CMD", a shell command that takes the place of uav_agent; nullopt for a planner of our own.
std::optional<std::string> exec_command(const std::string& spec);

/// Flown by every UAV for which the user named none.
inline constexpr const char* kDefaultPlanner = "patrol";

struct Planners {
  std::vector<UavPlanner> uavs;  ///< fleet order
  /// What the ground station runs, if the user said so: a strategy, "exec:CMD" or "none".
  std::optional<std::string> ground;
  std::string fallback;  ///< what flies the UAVs that were not named
};

/// Reads `NAME`, `UAV=NAME,...` or both (`patrol,jurong=hover`: patrol for all but jurong). A comma after a planner
/// with parameters continues its parameters unless a UAV's name and '=' follow: `jurong=kios:voxel=4,reserve=2`.
/// In place of NAME may stand `exec:CMD`. CMD goes on, commas and all, to the end of the text or to a comma that a
/// UAV's name and '=' follow; so a planner for all others stands before it: `hover,jurong=exec:./mine --speed 3`.
/// `gcs=NAME` names the program at the ground station.
/// @param fleet names of all UAVs.
/// @throws InputError for an unknown UAV, an empty name or command, or two planners for one UAV.
Planners parse_planners(const std::string& text, const std::vector<std::string>& fleet);

/// The text made fit for a folder's name: letters, digits, '.', '_' and '-' stay, all else becomes '_'; the first 100
/// characters.
std::string planner_label(const std::string& text);

}  // namespace skein::cli
