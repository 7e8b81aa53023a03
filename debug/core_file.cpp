#include "debug/core_file.hpp"

#include <fnmatch.h>
#include <sys/resource.h>

#include <fstream>
#include <system_error>

#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kSettings = "/proc/sys/kernel";

std::string setting(const char* name) {
  std::ifstream in(kSettings / name);
  std::string line;
  std::getline(in, line);
  return line;
}

/// Older cores are from another run.
fs::file_time_type allowed_since = fs::file_time_type::min();

/// The newest core whose name matches; `name` may have '*' in its last part.
std::optional<fs::path> newest(const fs::path& name) {
  std::optional<fs::path> found;
  fs::file_time_type when;
  std::error_code error;
  for (fs::directory_iterator entry(fs::absolute(name).parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code gone;
    if (::fnmatch(name.filename().c_str(), entry->path().filename().c_str(), 0) != 0) continue;
    const fs::file_time_type written = entry->last_write_time(gone);
    if (gone || !entry->is_regular_file(gone) || written < allowed_since || (found && written < when)) continue;
    found = entry->path();
    when = written;
  }
  return found;
}

}  // namespace

void allow_cores() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_CORE, &limit) != 0 || limit.rlim_max == 0) {
    throw InputError("--cores: this system lets no program leave a core (`ulimit -Hc` is 0)");
  }
  limit.rlim_cur = limit.rlim_max;
  allowed_since = fs::file_time_type::clock::now();
  if (::setrlimit(RLIMIT_CORE, &limit) != 0) throw std::system_error(errno, std::generic_category(), "--cores");
}

std::optional<std::string> core_name(std::string_view pattern, bool adds_pid, pid_t pid) {
  if (pattern.starts_with('|')) return std::nullopt;
  std::string name;
  bool has_pid = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      name += pattern[i];
    } else if (++i < pattern.size()) {
      has_pid = has_pid || pattern[i] == 'p';
      name += pattern[i] == '%' ? "%" : pattern[i] == 'p' ? std::to_string(pid) : "*";
    }
  }
  if (adds_pid && !has_pid) name += "." + std::to_string(pid);
  return name;
}

std::string keep_core(pid_t pid, const fs::path& file) {
  const std::string pattern = setting("core_pattern");
  const auto name = core_name(pattern, setting("core_uses_pid") == "1", pid);
  if (!name) return "its core went to " + pattern.substr(1);
  const auto core = newest(file.parent_path() / *name);  // a crashing program changes to its results folder
  if (!core) return {};
  std::error_code error;
  fs::rename(*core, file, error);
  if (error) {  // on another file system
    fs::copy_file(*core, file, fs::copy_options::overwrite_existing, error);
    if (error) return "core in " + core->string();
    fs::remove(*core, error);
  }
  return "core in " + file.filename().string();
}

}  // namespace skein::cli
