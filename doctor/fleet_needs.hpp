// Resources that a fleet needs from its machine. Estimates, rounded up, from measurements with both DDS vendors: files
// and threads with fleets of 5 UAVs, memory with fleets of 1 to 100 UAVs (docs/performance.md).   Pure.
#pragma once

#include <cstddef>
#include <cstdint>

#include "process/host/memory.hpp"
#include "process/host/open_files.hpp"

namespace skein::doctor {

struct FleetNeeds {
  std::size_t uavs = 0;

  /// Number of DDS domains: the world's, the ground station's, and one per UAV.
  std::uint64_t domains() const { return uavs + 2; }
  /// Open files of the server.
  std::uint64_t open_files() const { return ample_open_files(domains()); }
  /// Threads of all programs; the kernel's limits count each thread as a process. The server and the router have six
  /// threads each per domain.
  std::uint64_t threads() const { return 32 + 12 * domains() + 9 * uavs; }
  std::uint64_t memory_bytes() const { return fleet_memory(uavs); }
};

inline constexpr std::uint64_t kSocketBuffer = 4 * 1024 * 1024;  ///< size that both vendors request [bytes]
inline constexpr std::uint64_t kLeastDisk = 20'000'000;          ///< less than a run of ten minutes writes [bytes]
inline constexpr std::uint64_t kAmpleDisk = 500'000'000;         ///< with less, the doctor warns [bytes]

}  // namespace skein::doctor
