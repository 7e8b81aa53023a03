// CPU time that a program takes per simulated second, from the totals that the program reports.
// Pure. Not thread-safe.
#pragma once

#include <optional>

#include "core/types.hpp"

namespace skein::sim {

class CpuRate {
 public:
  /// @param cpu_s  total since the program started [s]; a smaller total than before means that it was restarted.
  void add(Tick tick, double cpu_s) {
    if (!begin_ || cpu_s < begin_->cpu_s) {
      begin_ = {tick, cpu_s};
      per_s_.reset();
    }
    // Average over a simulated second at least, because a program computes more in some exchanges than in others.
    const Tick passed = tick - begin_->tick;
    if (passed < kTicksPerSecond) return;
    per_s_ = (cpu_s - begin_->cpu_s) / seconds(passed);
    begin_ = {tick, cpu_s};
  }
  /// [s] of CPU time per simulated second; nullopt: not known yet.
  const std::optional<double>& per_s() const { return per_s_; }

 private:
  struct Reading {
    Tick tick = 0;
    double cpu_s = 0.0;
  };
  std::optional<Reading> begin_;
  std::optional<double> per_s_;
};

}  // namespace skein::sim
