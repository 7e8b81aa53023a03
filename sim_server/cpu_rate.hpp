// How much CPU time a program takes for a simulated second, of what it says it has taken since it started.
// Pure; any thread.
#pragma once

#include <optional>

#include "core/types.hpp"

namespace skein::sim {

class CpuRate {
 public:
  /// @param cpu_s  so far; less than before: it was started again.
  void add(Tick tick, double cpu_s) {
    if (!begin_ || cpu_s < begin_->cpu_s) {
      begin_ = {tick, cpu_s};
      per_s_.reset();
    }
    // Over a second at least: a program thinks more in one exchange than in another.
    const Tick passed = tick - begin_->tick;
    if (passed < kTicksPerSecond) return;
    per_s_ = (cpu_s - begin_->cpu_s) / seconds(passed);
    begin_ = {tick, cpu_s};
  }
  /// [s] for a simulated second; nullopt: not known yet.
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
