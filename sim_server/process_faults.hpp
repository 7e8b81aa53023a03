// Finds the faults of a plan that kill or stop a program and begin or end with an exchange.
// Threads: one.   Pure: the caller kills, stops and restarts the programs.
#pragma once

#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"

namespace skein::sim {

class ProcessFaults {
 public:
  struct Victim {
    std::string member;
    bool killed = false;  ///< else stopped
    std::string kind;     ///< of the fault, as fault files spell it
  };

  /// @param plan  must outlive this. Meanwhile the server may set off its faults that wait for a condition, append
  /// further faults, and give these an end.
  explicit ProcessFaults(const FaultPlan& plan) : plan_(plan) {}
  explicit ProcessFaults(FaultPlan&&) = delete;

  /// The programs whose fault begins with the exchange at this tick, in the plan's order.
  std::vector<Victim> take_beginning(Tick tick);
  /// The programs whose fault was in force and is over in the exchange at this tick.
  std::vector<Victim> take_ending(Tick tick);

 private:
  std::vector<Victim> take(Tick tick, bool beginning);

  const FaultPlan& plan_;
  std::vector<bool> acting_;  ///< by fault of the plan: whether it is in force
};

}  // namespace skein::sim
