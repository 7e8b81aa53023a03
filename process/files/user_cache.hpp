// The user's cache folder, for files that programs can generate again.
#pragma once

#include <filesystem>
#include <optional>

namespace skein {

/// ${XDG_CACHE_HOME}/skein, else ~/.cache/skein; nullopt if the environment names neither, as an absolute path.
std::optional<std::filesystem::path> user_cache_folder();

}  // namespace skein
