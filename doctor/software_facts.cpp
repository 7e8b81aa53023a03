#include "doctor/software_facts.hpp"

#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <set>
#include <utility>

#include "core/files/command_file.hpp"
#include "core/text/text.hpp"
#include "process/host/environment.hpp"

namespace skein::doctor {
namespace {

namespace fs = std::filesystem;

/// Adds the names of the files in /dev/shm that a process has mapped.
void add_mapped(const fs::path& maps, std::set<std::string>& names) {
  constexpr std::string_view kFolder = "/dev/shm/";
  std::ifstream in(maps);
  for (std::string line; std::getline(in, line);) {
    if (const std::size_t at = line.find(kFolder); at != std::string::npos)
      names.insert(line.substr(at + kFolder.size()));
  }
}

/// Adds the names of the files in /dev/shm that a process has open: Fast DDS does not map its lock files.
void add_open(const fs::path& descriptors, std::set<std::string>& names) {
  std::error_code error;
  for (fs::directory_iterator entry(descriptors, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    const fs::path file = fs::read_symlink(entry->path(), gone);
    if (file.parent_path() == "/dev/shm") names.insert(file.filename());
  }
}

/// Names of the files in /dev/shm that any visible process uses.
std::set<std::string> used_names(const fs::path& proc) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(proc, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().find_first_not_of("0123456789") != std::string::npos) continue;
    add_mapped(entry->path() / "maps", names);
    add_open(entry->path() / "fd", names);
  }
  return names;
}

/// Libraries of DDS vendors that this process has loaded; a fleet's programs load the same.
std::set<fs::path> loaded_dds_libraries() {
  std::set<fs::path> libraries;
  std::ifstream in("/proc/self/maps");
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find('/');
    if (at == std::string::npos) continue;
    const fs::path file = line.substr(at);
    for (const char* name : {"libddsc.so", "libfastrtps.so", "libfastcdr.so"}) {
      if (file.filename().string().starts_with(name)) libraries.insert(file);
    }
  }
  return libraries;
}

/// Whether a command succeeded, and the first line of its output. Stops it after 5 s: clients hang with their engine.
std::pair<bool, std::string> answer_of(const std::string& command) {
  const std::string limited = "timeout 5 " + command + " 2>&1 </dev/null";
  FILE* const pipe = ::popen(limited.c_str(), "re");
  if (pipe == nullptr) return {false, "cannot be started"};
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text.push_back(static_cast<char>(c));
  const int status = ::pclose(pipe);
  text.erase(0, text.find_first_not_of('\n'));
  text = text.substr(0, text.find('\n'));
  constexpr int kTimedOut = 124;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kTimedOut) text = "no answer in 5 s";
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, text};
}

}  // namespace

SharedMemoryFacts read_shared_memory(const fs::path& root) {
  SharedMemoryFacts facts;
  const fs::path folder = root / "dev/shm";
  struct statvfs room {};
  facts.there = ::statvfs(folder.c_str(), &room) == 0;
  if (!facts.there) return facts;
  facts.writable = ::access(folder.c_str(), W_OK) == 0;
  facts.free = std::uint64_t{room.f_bavail} * room.f_frsize;
  std::vector<fs::path> segments;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    const bool of_fast_dds =
        name.starts_with("fastrtps_") || name.starts_with("sem.fastrtps_") || name.starts_with("fast_datasharing_");
    if (of_fast_dds) segments.push_back(entry->path());
  }
  facts.segments = segments.size();
  if (segments.empty()) return facts;
  const std::set<std::string> used = used_names(root / "proc");
  for (const fs::path& segment : segments) {
    if (used.contains(segment.filename())) continue;
    std::error_code gone;
    const std::uintmax_t bytes = fs::file_size(segment, gone);
    ++facts.unused;
    if (!gone) facts.unused_bytes += bytes;
  }
  return facts;
}

VariableFacts read_variables() {
  VariableFacts facts{.ignored = ignored_variables(), .vendor = {}};
  const char* path = std::getenv("LD_LIBRARY_PATH");
  if (path == nullptr) return facts;
  for (const fs::path& library : loaded_dds_libraries()) {
    for (const std::string& folder : split(path, ':')) {
      std::error_code error;
      if (folder.empty() || !fs::equivalent(folder, library.parent_path(), error)) continue;
      facts.vendor.push_back(library);
      break;
    }
  }
  return facts;
}

DockerFacts ask_docker() {
  DockerFacts facts;
  facts.client = !command_file("docker").empty();
  if (!facts.client) return facts;
  if (const char* host = std::getenv("DOCKER_HOST")) facts.host = host;
  const auto [answers, version] = answer_of("docker version --format '{{.Server.Version}}'");
  (answers ? facts.engine.emplace() : facts.trouble) = version;
  for (const char* compose : {"docker compose", "docker-compose"}) {
    if (facts.compose || (std::string(compose) == "docker-compose" && command_file(compose).empty())) continue;
    const auto [there, number] = answer_of(std::string(compose) + " version --short");
    if (there && !number.empty()) facts.compose = std::string(compose) + " " + number;
  }
  return facts;
}

}  // namespace skein::doctor
