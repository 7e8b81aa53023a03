// What the machine grants a fleet: limits of the kernel, of the shell and of a container; disk, clocks. Only reads, but
// for one file that it makes in the results folder and takes away.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace skein::doctor {

/// Bytes or a count; nullopt: no limit, or none that can be seen from here.
using Limit = std::optional<std::uint64_t>;

/// Of this process's cgroup and all those above it.
struct CgroupFacts {
  Limit memory_left{};           ///< [bytes] what is cached counts as left
  std::optional<double> cpus{};  ///< a quota
  Limit processes{};             ///< threads count each
};

struct MachineFacts {
  std::string container{};  ///< by what it is known to be one; empty: none
  CgroupFacts cgroup;
  Limit open_files{}, most_open_files{};  ///< of a process; what it may be raised to
  Limit processes{};                      ///< of this user, threads count each
  Limit receive_buffer{}, send_buffer{};  ///< [bytes] that a socket may ask for
  Limit memory{};                         ///< [bytes] available
  int cpus = 1;
};

struct DiskFacts {
  std::filesystem::path folder{};  ///< the results folder, or the one above it that exists
  Limit free{};                    ///< [bytes]
  std::string no_file{};           ///< why no file could be made; empty: it could
};

struct ClockFacts {
  double monotonic_s = 0.0, realtime_s = 0.0;  ///< by which they went on over the same while
  double date_s = 0.0;                         ///< since 1970
  std::string source{};                        ///< the kernel's; empty: not told
};

/// @param root  for tests: where proc/ and sys/ are looked for.
CgroupFacts read_cgroup(const std::filesystem::path& root = "/");
MachineFacts read_machine();
DiskFacts read_disk(const std::filesystem::path& results);
/// Takes some milliseconds.
ClockFacts read_clocks();

}  // namespace skein::doctor
