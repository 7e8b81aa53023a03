#include "host/proc_table.hpp"

#include <dirent.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace skein::cli {
namespace {

std::ifstream open_file(pid_t pid, const std::string& what) {
  return std::ifstream("/proc/" + std::to_string(pid) + "/" + what, std::ios::binary);
}

/// The rest of a line of `status` that begins with `key`.
std::string status_of(pid_t pid, const std::string& key) {
  std::ifstream in = open_file(pid, "status");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(key + ":\t")) return line.substr(key.size() + 2);
  }
  return {};
}

}  // namespace

std::vector<pid_t> all_processes() {
  std::vector<pid_t> pids;
  DIR* const folder = ::opendir("/proc");
  if (folder == nullptr) return pids;
  while (const dirent* entry = ::readdir(folder)) {
    const pid_t pid = static_cast<pid_t>(std::strtol(entry->d_name, nullptr, 10));
    if (pid > 0) pids.push_back(pid);
  }
  ::closedir(folder);
  return pids;
}

pid_t parent_of(pid_t pid) { return static_cast<pid_t>(std::strtol(status_of(pid, "PPid").c_str(), nullptr, 10)); }

pid_t tracer_of(pid_t pid) { return static_cast<pid_t>(std::strtol(status_of(pid, "TracerPid").c_str(), nullptr, 10)); }

bool has_stopped(pid_t pid) { return status_of(pid, "State").starts_with("T"); }

std::string process_name(pid_t pid) { return status_of(pid, "Name"); }

std::vector<std::string> words_of(pid_t pid, const std::string& what) {
  std::ifstream in = open_file(pid, what);
  std::vector<std::string> words;
  for (std::string word; std::getline(in, word, '\0');) words.push_back(word);
  return words;
}

std::vector<uid_t> users_of(pid_t pid) {
  std::vector<uid_t> users;
  if (status_of(pid, "State").starts_with("Z")) return users;
  std::istringstream ids(status_of(pid, "Uid"));
  for (uid_t id = 0; ids >> id;) users.push_back(id);
  return users;
}

bool belongs_to(pid_t pid, uid_t user) {
  const std::vector<uid_t> users = users_of(pid);
  return std::find(users.begin(), users.end(), user) != users.end();
}

bool shares_network(pid_t pid) {
  const auto network = [](const std::string& process) {
    std::error_code closed;
    return std::filesystem::read_symlink("/proc/" + process + "/ns/net", closed).string();
  };
  return network(std::to_string(pid)) == network("self");
}

}  // namespace skein::cli
