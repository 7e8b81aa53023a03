// The faults of a plan that kill or stop a program: which begin and which end with an exchange.
// Threads: one.   Pure: what becomes of the programs is the caller's business.
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
    std::string kind;     ///< of the fault, as files spell it
  };

  /// @param plan  must outlive this. Meanwhile its faults that wait for a condition may be set off, others may be added
  /// at its end, and get an end.
  explicit ProcessFaults(const FaultPlan& plan) : plan_(plan) {}
  explicit ProcessFaults(FaultPlan&&) = delete;

  /// Those that begin with the exchange at this tick, in the plan's order.
  std::vector<Victim> take_beginning(Tick tick);
  /// Those that act, and will no longer in the exchange at this tick.
  std::vector<Victim> take_ending(Tick tick);

 private:
  std::vector<Victim> take(Tick tick, bool beginning);

  const FaultPlan& plan_;
  std::vector<bool> acting_;  ///< by fault of the plan
};

}  // namespace skein::sim
