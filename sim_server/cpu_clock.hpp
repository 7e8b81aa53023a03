// CPU time of this thread and its helpers by kind of work. What it does between its kinds of work is the exchange.
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
  /// `physics_s` is what the simulation did besides LiDAR, camera and links; lidar_ms_per_scan is there when there was
  /// a scan; cpu_s is the caller's to fill in.
  TimingReport summary() const;

 private:
  struct Account {
    double began_s = 0.0, total_s = 0.0;
    std::uint64_t count = 0;
  };
  std::array<Account, kWorkKinds> accounts_{};
};

}  // namespace skein::sim
