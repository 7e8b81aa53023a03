// UAVs that a person flies by hand (--planner jurong=hand), and how such a flight is repeated without that person: from
// the file of commands that the run recorded (--planner jurong=hand:FILE).   Threads: any.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "run/planner_spec.hpp"

namespace skein::cli {

/// UAVs whose planner is `hand` without a file of commands, in fleet order.
/// @throws InputError when the parameters of such a planner cannot be read.
std::vector<std::string> flown_by_hand(const std::vector<UavPlanner>& planners);

/// @param watched  whether a page is served on which a person can fly.
/// @param stepped  whether a program steps the fleet and commands the learners (--planner jurong=learner).
/// @throws InputError when a UAV needs a person without `watched`, or a learner without `stepped`.
void check_hands(const std::vector<UavPlanner>& planners, bool watched, bool stepped = false);

/// The value of --planner that repeats the flight from recorded commands.
/// @param text, fleet  as for parse_planners(). @param file_of  gives the file with a UAV's recorded commands.
std::string planners_repeated(const std::string& text, const std::vector<std::string>& fleet,
                              const std::function<std::filesystem::path(const std::string& uav)>& file_of);

}  // namespace skein::cli
