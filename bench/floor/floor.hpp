// The floor is the baseline of `skein bench`: the least that lock-step rounds cost over a DDS vendor. The same
// processes exchange the same messages in the same order over the vendor's own API, without counting, inbox, codec,
// physics or planner.
#pragma once

#include <cstdint>

#include "bench/floor/vendor.hpp"

namespace skein::bench {

struct FloorOptions {
  std::size_t uavs = 5;
  std::uint64_t rounds = 1000;
  int base_domain = 0;
};

struct FloorResult {
  std::uint64_t rounds = 0;
  double wall_s = 0.0;                    ///< of the rounds after the warm-up, from the server's first write in them to
                                          ///< the last sample that it receives
  double cpu_s = 0.0;                     ///< of all processes in that time
  double server_cpu_s = 0.0;              ///< of the server alone
  std::uint64_t messages = 0, bytes = 0;  ///< delivered per round (payloads)
};

/// Forks a process for each seat except the server's, which the calling process takes. Call it before any other thread
/// exists. Blocks until all rounds are done.
/// @throws std::runtime_error when a process fails or a round takes longer than a minute.
FloorResult run_floor(const FloorOptions& options);

}  // namespace skein::bench
