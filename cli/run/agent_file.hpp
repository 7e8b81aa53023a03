// Finds the agent programs of a fleet, and asks them for the strategies that they have.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/planner_spec.hpp"

namespace skein::cli {

/// The fleet's agent program: `chosen` (--agent), else SKEIN_AGENT, else the uav_agent beside the launcher.
/// @returns its absolute path; nullopt: that uav_agent, also if the user named it.
/// @throws InputError if there is no such program, or it is not an agent program.
std::optional<std::filesystem::path> own_agent(const std::optional<std::filesystem::path>& chosen);

/// Finds the agent programs of planners NAME@AGENT, relative to the working directory, and makes their paths absolute.
/// Removes an AGENT that is the fleet's uav_agent anyway, unless the planner's own spec contains an '@'.
/// @param own  the fleet's agent program; nullopt: uav_agent.
/// @throws InputError if a program does not exist, is not an agent program, or does not have a UAV's planner.
void find_agents(Planners& planners, const std::optional<std::filesystem::path>& own);

/// Names of an agent program's strategies for UAVs, in the order in which it lists them.
/// @returns none if the program is missing or prints no list.
std::vector<std::string> planners_of(const std::filesystem::path& agent);

/// Names of an agent program's strategies that have a program at the ground station.
/// @returns none if the program is missing or prints no list.
std::vector<std::string> ground_programs_of(const std::filesystem::path& agent);

}  // namespace skein::cli
