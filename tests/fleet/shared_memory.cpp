#include "shared_memory.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// The files that a process has mapped or open, from /proc; empty if it has ended meanwhile.
std::set<fs::path> files_of(const fs::path& process) {
  std::set<fs::path> files;
  std::ifstream maps(process / "maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t path = line.find('/');
    if (path != std::string::npos) files.insert(line.substr(path));
  }
  std::error_code ended;
  for (fs::directory_iterator it(process / "fd", ended), end; !ended && it != end; it.increment(ended)) {
    std::error_code closed;
    files.insert(fs::read_symlink(it->path(), closed));
  }
  return files;
}

}  // namespace

std::set<std::string> shared_memory(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    names.insert(it->path().filename());
  }
  return names;
}

std::set<std::string> unused_shared_memory(std::set<std::string> names, const fs::path& folder) {
  std::error_code ignored;
  for (fs::directory_iterator it("/proc", ignored), end; !names.empty() && it != end; it.increment(ignored)) {
    const std::string pid = it->path().filename();
    if (!std::ranges::all_of(pid, [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    const std::set<fs::path> used = files_of(it->path());
    std::erase_if(names, [&](const std::string& name) { return used.contains(folder / name); });
  }
  return names;
}

}  // namespace skein::test
