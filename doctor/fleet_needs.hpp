// What a fleet asks of its machine, about: measured with fleets of 5 (files, threads) and of 1 to 100 UAVs (memory,
// docs/performance.md) over both vendors, rounded up.   Pure.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skein::doctor {

struct FleetNeeds {
  std::size_t uavs = 0;

  /// World, ground station, and one a UAV.
  std::uint64_t domains() const { return uavs + 2; }
  /// Open files of the server, which joins all domains; no program has more.
  std::uint64_t open_files() const { return 16 + 9 * domains(); }
  /// Of all programs, each of which counts as a process to the kernel: server and router have six a domain.
  std::uint64_t threads() const { return 32 + 12 * domains() + 9 * uavs; }
  std::uint64_t memory_bytes() const { return (90 + 9 * uavs) * 1'000'000; }
};

inline constexpr std::uint64_t kSocketBuffer = 4 * 1024 * 1024;  ///< that both vendors ask for
inline constexpr std::uint64_t kLeastDisk = 20'000'000;          ///< less than a run of ten minutes writes
inline constexpr std::uint64_t kAmpleDisk = 500'000'000;

}  // namespace skein::doctor
