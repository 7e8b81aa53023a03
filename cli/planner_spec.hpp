// What the user wrote after --planner, taken apart: which planner flies which UAV.
#pragma once

#include <string>
#include <vector>

namespace skein::cli {

struct UavPlanner {
  std::string uav;
  std::string spec;  ///< as uav_agent takes it: a name, with parameters if any ("waypoints:file=tour.yaml")
};

/// Flown by every UAV for which the user named none.
inline constexpr const char* kDefaultPlanner = "patrol";

/// Reads `NAME`, `UAV=NAME,...` or both (`patrol,jurong=hover`: patrol for all but jurong). A comma after a planner
/// with parameters continues its parameters unless a UAV's name and '=' follow: `jurong=kios:voxel=4,reserve=2`.
/// @param fleet names of all UAVs. @returns one entry a UAV, in the order of `fleet`.
/// @throws InputError for an unknown UAV, an empty name, or two planners for one UAV.
std::vector<UavPlanner> parse_planners(const std::string& text, const std::vector<std::string>& fleet);

/// The text made fit for a folder's name: letters, digits, '.', '_' and '-' stay, all else becomes '_'.
std::string planner_label(const std::string& text);

}  // namespace skein::cli
