// What the agents of a fleet in containers write goes to folders of their own, one each, below the run's.
#pragma once

#include <filesystem>

namespace skein::cli {

/// Below the run's folder: agents/jurong and so on.
inline constexpr const char* kAgentsFolder = "agents";

/// Moves what agents wrote to the results of all, and removes the folders. A file that does not bear its agent's name,
/// nor is of its maps in time, is dropped: an agent speaks for itself alone. Without such folders it does nothing.
/// @throws std::filesystem::filesystem_error
void gather_agents(const std::filesystem::path& out);

}  // namespace skein::cli
