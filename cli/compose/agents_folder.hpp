// In containers, each agent of a fleet writes to a folder of its own below the run's results folder.   Threads: any.
#pragma once

#include <filesystem>

namespace skein::cli {

/// The folder that contains them: agents/jurong and so on.
inline constexpr const char* kAgentsFolder = "agents";

/// Moves the agents' files to the results folder, and removes the agents' folders. Drops a file that neither has its
/// agent's name nor is one of the agent's maps in time: an agent must not write another's results. Does nothing without
/// such folders. @param out  the results folder.
/// @throws std::filesystem::filesystem_error
void gather_agents(const std::filesystem::path& out);

}  // namespace skein::cli
