// CPU time of this thread by kind of work.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "sim_server/work_clock.hpp"

namespace skein::sim {

class CpuClock final : public WorkClock {
 public:
  void begin(Work work) override;
  void end(Work work) override;
  /// Seconds by kind of work (`physics_s` is what the simulation did besides the others), and lidar_ms_per_scan.
  nlohmann::json summary() const;

 private:
  struct Account {
    double began_s = 0.0, total_s = 0.0;
    std::uint64_t count = 0;
  };
  std::array<Account, kWorkKinds> accounts_{};
};

/// CPU time of the calling thread [s].
double thread_cpu_s();

}  // namespace skein::sim
