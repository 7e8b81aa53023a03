// Finds the agent programs of a fleet, and asks them which strategies they have.
// Starts programs to ask them.   Threads: one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/planner_spec.hpp"

namespace skein::cli {

/// The fleet's agent program: `chosen` (--agent), else SKEIN_AGENT, else the uav_agent beside the launcher.
/// @returns its absolute path; nullopt if it is the uav_agent beside the launcher, even if the user named that file.
/// @throws InputError if the file does not exist, cannot be executed, or is not an agent program.
std::optional<std::filesystem::path> own_agent(const std::optional<std::filesystem::path>& chosen);

/// Finds the agent programs of planners NAME@AGENT. Makes their paths absolute; relative paths count from the working
/// directory. If the fleet's agent program is uav_agent, removes an AGENT that names the same program, unless the
/// planner's own spec contains an '@': without AGENT, the text after this '@' would be read as an AGENT.
/// @param own  the fleet's agent program; nullopt: uav_agent.
/// @throws InputError if a file does not exist, cannot be executed, is not an agent program, or does not have the
///   planner of a UAV.
void find_agents(Planners& planners, const std::optional<std::filesystem::path>& own);

/// Names of an agent program's strategies for UAVs, in the order in which it lists them.
/// @returns an empty list if the program is missing or prints no list.
std::vector<std::string> planners_of(const std::filesystem::path& agent);

/// Names of an agent program's strategies that have a program at the ground station.
/// @returns an empty list if the program is missing or prints no list.
std::vector<std::string> ground_programs_of(const std::filesystem::path& agent);

}  // namespace skein::cli
