// Closes ground truth that earlier runs left where the agents of a secured run could read it. Effective only as root.
#pragma once

#include <filesystem>

namespace skein::cli {

/// Closes to agents (process/files/closed_to_agents.hpp) the results folders beside `out`, of all users, and in
/// the user's cache the scenes, their points, estimates and plans. A launcher that runs as root closes its own files as
/// it writes them: this function is for files that an ordinary user or an older version wrote.
void close_earlier_truth(const std::filesystem::path& out);

}  // namespace skein::cli
