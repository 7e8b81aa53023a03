// CPU time of this thread by kind of work. What the thread does between its kinds of work is the exchange.
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
  /// Seconds by kind of work: `physics_s` is what the simulation did besides LiDAR, camera and links. Also the number of
  /// scans and exposures that were computed, and lidar_ms_per_scan when there was one.
  nlohmann::json summary() const;

 private:
  struct Account {
    double began_s = 0.0, total_s = 0.0;
    std::uint64_t count = 0;
  };
  std::array<Account, kWorkKinds> accounts_{};
};

}  // namespace skein::sim
