// UAVs that somebody flies by hand (--planner jurong=hand): who they are, and how such a flight is repeated without
// hands: from the file that it left of what was wanted (--planner jurong=hand:FILE).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/planner_spec.hpp"

namespace skein::cli {

/// UAVs whose planner is `hand` without a file of commands, in fleet order.
/// @throws InputError when the parameters of such a planner cannot be read.
std::vector<std::string> flown_by_hand(const std::vector<UavPlanner>& planners);

/// @param watched  whether there is a page on which somebody can fly.
/// @param stepped  whether a program steps the fleet, and says what learners do (--planner jurong=learner).
/// @throws InputError when somebody must fly, and cannot.
void check_hands(const std::vector<UavPlanner>& planners, bool watched, bool stepped = false);

/// --planner of the same flight without hands.
/// @param text, fleet  as for parse_planners(). @param file_of  what was kept of the commands of a UAV.
std::string planners_repeated(const std::string& text, const std::vector<std::string>& fleet,
                              const std::function<std::filesystem::path(const std::string& uav)>& file_of);

}  // namespace skein::cli
