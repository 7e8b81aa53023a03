// Which programs the UAVs' on-board software is, and which strategies they know.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/planner_spec.hpp"

namespace skein::cli {

/// The program to fly with, where it is not the uav_agent beside the launcher: `chosen` (--agent), else SKEIN_AGENT.
/// @returns its absolute path; nullopt: uav_agent, also when that is what was named.
/// @throws InputError when there is no such program, or it is no agent.
std::optional<std::filesystem::path> own_agent(const std::optional<std::filesystem::path>& chosen);

/// Looks for the programs of NAME@AGENT, relative to the working directory, and makes their paths absolute. Of
/// uav_agent none is left where it is the fleet's. @param own  the fleet's, where it is not uav_agent.
/// @throws InputError when there is no such program, it is no agent, or does not know a UAV's planner.
void find_agents(Planners& planners, const std::optional<std::filesystem::path>& own);

/// Names of an agent program's strategies for UAVs, in their order.
/// @returns none when it is missing or does not tell.
std::vector<std::string> planners_of(const std::filesystem::path& agent);

/// Names of an agent program's strategies that have a program at the ground station.
/// @returns none when it is missing or does not tell.
std::vector<std::string> ground_programs_of(const std::filesystem::path& agent);

}  // namespace skein::cli
