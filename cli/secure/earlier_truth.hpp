// Ground truth that earlier runs left where the agents of a secured run could read it. Only for root.
#pragma once

#include <filesystem>

namespace skein::cli {

/// Closes to agents (process/files/closed_to_agents.hpp) the results that lie beside `out`, whoever flew them, and
/// scenes, their points, estimates and plans in the user's cache. Launchers that run as root close what they write
/// themselves: this is for what an ordinary user or an older version wrote.
void close_earlier_truth(const std::filesystem::path& out);

}  // namespace skein::cli
