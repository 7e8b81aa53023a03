#include "process/files/user_cache.hpp"

#include <cstdlib>

namespace skein {

namespace fs = std::filesystem;

std::optional<fs::path> user_cache_folder() {
  const auto variable = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  if (const fs::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "skein";
  if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "skein";
  return std::nullopt;
}

}  // namespace skein
