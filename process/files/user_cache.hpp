// The user's cache folder, for files that programs can generate again.
#pragma once

#include <filesystem>
#include <optional>

namespace skein {

/// ${XDG_CACHE_HOME}/skein, else ~/.cache/skein; nullopt where the environment names neither.
std::optional<std::filesystem::path> user_cache_folder();

}  // namespace skein
