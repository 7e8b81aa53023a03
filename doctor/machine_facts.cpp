#include "doctor/machine_facts.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/text/text.hpp"
#include "core/text/whole_number.hpp"
#include "process/host/open_files.hpp"

namespace skein::doctor {
namespace {

namespace fs = std::filesystem;

/// The first word of a file; empty when it cannot be read.
std::string word_in(const fs::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

/// The number after a key in a file of lines "KEY NUMBER ...".
Limit entry_in(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string name, value;
    if (words >> name >> value && name == key) return parse_whole(value);
  }
  return std::nullopt;
}

template <class Value>
void take_less(std::optional<Value>& least, const std::optional<Value>& other) {
  if (other && (!least || *other < *least)) least = other;
}

/// Folders of this process's cgroup and of all its ancestors, up to `mount`: in a container, the engine may show the
/// container's own cgroup as the root.
std::vector<fs::path> folders_of(const fs::path& mount, const std::string& cgroup) {
  std::vector<fs::path> folders;
  for (fs::path path = fs::path(cgroup).relative_path(); !path.empty(); path = path.parent_path()) {
    folders.push_back(mount / path);
  }
  folders.push_back(mount);
  return folders;
}

/// What is left of the limit `most`: `used` is in use, but the kernel frees `cached` of it on demand.
Limit left_of(Limit most, Limit used, Limit cached) {
  if (!most) return std::nullopt;
  const std::uint64_t held = used.value_or(0) - std::min(used.value_or(0), cached.value_or(0));
  return *most - std::min(*most, held);
}

/// Reads a folder of cgroup v2.
void read_unified(const fs::path& folder, CgroupFacts& facts) {
  take_less(facts.memory_left,
            left_of(parse_whole(word_in(folder / "memory.max")), parse_whole(word_in(folder / "memory.current")),
                    entry_in(folder / "memory.stat", "inactive_file")));
  take_less(facts.processes, parse_whole(word_in(folder / "pids.max")));
  std::ifstream quota(folder / "cpu.max");
  std::string most, period;
  if (!(quota >> most >> period)) return;
  const Limit time = parse_whole(most), of = parse_whole(period);
  if (time && of && *of > 0)
    take_less(facts.cpus, std::optional(static_cast<double>(*time) / static_cast<double>(*of)));
}

/// Reads a folder of cgroup v1, which shows "no memory limit" as a number near 2^63.
void read_former(const std::string& controller, const fs::path& folder, CgroupFacts& facts) {
  constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;
  if (controller == "memory") {
    Limit most = parse_whole(word_in(folder / "memory.limit_in_bytes"));
    if (most && *most > kUnlimited) most.reset();
    take_less(facts.memory_left, left_of(most, parse_whole(word_in(folder / "memory.usage_in_bytes")),
                                         entry_in(folder / "memory.stat", "total_inactive_file")));
  } else if (controller == "pids") {
    take_less(facts.processes, parse_whole(word_in(folder / "pids.max")));
  } else if (controller == "cpu") {
    const Limit time = parse_whole(word_in(folder / "cpu.cfs_quota_us"));  // -1, which parse_whole() rejects: no limit
    const Limit of = parse_whole(word_in(folder / "cpu.cfs_period_us"));
    if (time && of && *of > 0) {
      take_less(facts.cpus, std::optional(static_cast<double>(*time) / static_cast<double>(*of)));
    }
  }
}

/// Evidence that this process runs in a container; empty: none.
std::string container_sign() {
  for (const char* file : {"/.dockerenv", "/run/.containerenv"}) {
    if (fs::exists(file)) return file;
  }
  const char* named = std::getenv("container");
  if (named != nullptr && *named != '\0') return std::string("container=") + named;
  std::ifstream in("/proc/1/cgroup");
  for (std::string line; std::getline(in, line);) {
    for (const char* engine : {"docker", "kubepods", "containerd", "libpod", "lxc"}) {
      if (line.find(engine) != std::string::npos) return std::string(engine) + " in /proc/1/cgroup";
    }
  }
  return {};
}

Limit resource(decltype(RLIMIT_NOFILE) which, rlim_t rlimit::*part) {
  rlimit limit{};
  if (::getrlimit(which, &limit) != 0 || limit.*part == RLIM_INFINITY) return std::nullopt;
  return limit.*part;
}

double seconds_of(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

CgroupFacts read_cgroup(const fs::path& root) {
  CgroupFacts facts;
  const fs::path mount = root / "sys/fs/cgroup";
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> parts = split(line, ':');
    if (parts.size() < 3) continue;
    if (parts[1].empty()) {
      for (const fs::path& folder : folders_of(mount, parts[2])) read_unified(folder, facts);
      continue;
    }
    for (const std::string& controller : split(parts[1])) {
      for (const fs::path& folder : folders_of(mount / controller, parts[2])) read_former(controller, folder, facts);
    }
  }
  return facts;
}

MachineFacts read_machine() {
  MachineFacts facts;
  facts.container = container_sign();
  facts.cgroup = read_cgroup();
  facts.open_files = open_files_limit();
  facts.most_open_files = resource(RLIMIT_NOFILE, &rlimit::rlim_max);
  facts.kernel_processes = parse_whole(word_in("/proc/sys/kernel/threads-max"));
  if (::geteuid() != 0) facts.processes = resource(RLIMIT_NPROC, &rlimit::rlim_cur);  // it does not hold for root
  facts.receive_buffer = parse_whole(word_in("/proc/sys/net/core/rmem_max"));
  facts.send_buffer = parse_whole(word_in("/proc/sys/net/core/wmem_max"));
  if (const Limit kb = entry_in("/proc/meminfo", "MemAvailable:")) facts.memory = *kb * 1024;
  cpu_set_t cpus;
  if (::sched_getaffinity(0, sizeof cpus, &cpus) == 0) facts.cpus = std::max(1, CPU_COUNT(&cpus));
  return facts;
}

DiskFacts read_disk(const fs::path& results) {
  DiskFacts facts;
  std::error_code error;
  facts.folder = (fs::absolute(results, error) / "").lexically_normal().parent_path();  // without a trailing slash
  while (!fs::is_directory(facts.folder, error) && facts.folder.has_relative_path()) {
    facts.folder = facts.folder.parent_path();
  }
  struct statvfs room {};
  if (::statvfs(facts.folder.c_str(), &room) == 0) facts.free = std::uint64_t{room.f_bavail} * room.f_frsize;
  std::string name = facts.folder / "skein-doctor-XXXXXX";
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) {
    facts.create_error = std::strerror(errno);
    return facts;
  }
  ::close(file);
  fs::remove(name, error);
  return facts;
}

ClockFacts read_clocks() {
  constexpr int kWhileMs = 20;
  const double monotonic = seconds_of(CLOCK_MONOTONIC), realtime = seconds_of(CLOCK_REALTIME);
  ::poll(nullptr, 0, kWhileMs);
  const double date = seconds_of(CLOCK_REALTIME);
  return {seconds_of(CLOCK_MONOTONIC) - monotonic, date - realtime, date,
          word_in("/sys/devices/system/clocksource/clocksource0/current_clocksource")};
}

}  // namespace skein::doctor
