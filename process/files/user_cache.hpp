// Where programs keep what they can make again.
#pragma once

#include <filesystem>
#include <optional>

namespace skein {

/// ${XDG_CACHE_HOME}/skein, else ~/.cache/skein; nullopt where the environment names neither.
std::optional<std::filesystem::path> user_cache_folder();

}  // namespace skein
