#include "core/config/config_files.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/text/suggestion.hpp"
#include "core/types.hpp"

namespace skein {

namespace fs = std::filesystem;

fs::path default_config_dir() {
  std::error_code ignored;
  if (const char* chosen = std::getenv("SKEIN_CONFIG_DIR"); chosen && *chosen) {
    if (!fs::is_directory(chosen, ignored)) {
      throw InputError(std::string("SKEIN_CONFIG_DIR: '") + chosen + "' is not a folder");
    }
    return chosen;
  }
  const fs::path bin = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path installed = bin.parent_path() / "share" / "skein" / "config";
  if (fs::is_directory(installed, ignored)) return installed;
  constexpr int kLevels = 4;
  fs::path above = bin;
  for (int level = 0; level < kLevels; ++level) {
    above = above.parent_path();
    if (fs::is_directory(above / "config" / "scenarios", ignored)) return above / "config";
  }
  throw InputError("no folder config/ with scenarios/ near " + bin.string() + ": set SKEIN_CONFIG_DIR to it");
}

fs::path find_config_file(const std::string& what, const std::string& name_or_path, const fs::path& folder,
                          const fs::path& base, const std::vector<std::string>& other_names) {
  std::error_code ignored;
  const bool is_path =
      name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".yaml") || name_or_path.ends_with(".yml");
  if (is_path) {
    const fs::path file = fs::path(name_or_path).is_absolute() ? fs::path(name_or_path) : base / name_or_path;
    if (!fs::is_regular_file(file, ignored)) throw InputError(file.string() + ": no such " + what + " file");
    return file;
  }
  const fs::path file = folder / (name_or_path + ".yaml");
  if (name_or_path.empty() || !fs::is_regular_file(file, ignored)) {
    std::vector<std::string> names = config_names(folder);
    names.insert(names.end(), other_names.begin(), other_names.end());
    throw InputError("no " + what + " is called '" + name_or_path + "' in " + folder.string() + "; " +
                     suggestion(name_or_path, names));
  }
  return file;
}

std::vector<std::string> config_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator it(folder, ignored), end; it != end; it.increment(ignored)) {
    if (it->path().extension() == ".yaml") names.push_back(it->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace skein
