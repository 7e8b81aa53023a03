// Sums the CPU time of the server by kind of work: of the thread that calls it, and of the helpers that share this
// thread's work. The rest of the CPU time is the exchange of messages.   Units: s.   Threads: one.
#pragma once

#include <array>
#include <cstdint>

#include "process/reports/reports.hpp"
#include "sim_server/work_clock.hpp"

namespace skein::sim {

class CpuClock final : public WorkClock {
 public:
  void begin(Work work) override;
  void end(Work work, std::size_t pieces) override;
  /// The sums so far. `physics_s` is the simulation without LiDAR, camera and links. `lidar_ms_per_scan` is empty if
  /// there was no scan. The caller fills in `cpu_s`.
  TimingReport summary() const;

 private:
  struct Account {
    double began_s = 0.0, total_s = 0.0;
    std::uint64_t count = 0;
  };
  std::array<Account, kWorkKinds> accounts_{};
};

}  // namespace skein::sim
