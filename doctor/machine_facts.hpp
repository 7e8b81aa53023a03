// Resources that the machine grants a fleet: limits of the kernel, of the shell and of a container; disk, clocks. Only
// reads, except that read_disk() creates one file in the results folder and deletes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace skein::doctor {

/// Bytes or a count; nullopt: no limit, or a limit that this process cannot see.
using Limit = std::optional<std::uint64_t>;

/// The lowest limits of this process's cgroup and of all its ancestors.
struct CgroupFacts {
  Limit memory_left{};           ///< [bytes]; reclaimable cache counts as free
  std::optional<double> cpus{};  ///< CPU quota, in CPUs
  Limit processes{};             ///< each thread counts
};

struct MachineFacts {
  std::string container{};  ///< evidence that this process runs in a container; empty: none found
  CgroupFacts cgroup;
  Limit open_files{}, most_open_files{};  ///< limit of a process; maximum to which the process may raise it
  Limit processes{}, kernel_processes{};  ///< of this user; of the whole host; each thread counts
  Limit receive_buffer{}, send_buffer{};  ///< [bytes]; maximum that a socket may request
  Limit memory{};                         ///< [bytes] available
  int cpus = 1;
};

struct DiskFacts {
  std::filesystem::path folder{};  ///< the results folder, or its nearest ancestor that exists
  Limit free{};                    ///< [bytes]
  std::string create_error{};      ///< why no file could be created; empty: one could
};

struct ClockFacts {
  double monotonic_s = 0.0, realtime_s = 0.0;  ///< time that each clock measured in the same interval
  double date_s = 0.0;                         ///< time of day, since 1970 [s]
  std::string source{};                        ///< the kernel's clock source; empty: unknown
};

/// @param root  folder that contains proc/ and sys/; for tests.
CgroupFacts read_cgroup(const std::filesystem::path& root = "/");
MachineFacts read_machine();
DiskFacts read_disk(const std::filesystem::path& results);
/// Blocks for some milliseconds.
ClockFacts read_clocks();

}  // namespace skein::doctor
