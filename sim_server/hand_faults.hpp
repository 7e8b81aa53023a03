// Faults that a viewer of a run begins and ends by hand. Each order takes effect with the next exchange, so that a
// fault file can describe the same faults. An order that no fault file could express is refused.
// Threads: one.   Pure: knows no bus, and writes no file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "view/fault_order.hpp"

namespace skein::sim {

/// A fault by hand.
struct HandFault {
  std::uint64_t number = 0;  ///< identifies the fault in an order to end it
  Fault fault;
};

class HandFaults {
 public:
  /// @param scenario  must outlive this. @param own  the faults of the run's fault file, as it was read.
  HandFaults(const Scenario& scenario, const FaultPlan& own);

  /// @param next  tick of the exchange that begins next, with which the order takes effect.
  /// @returns why the order is refused, for people; empty: it has been obeyed.
  std::string obey(const view::FaultOrder& order, Tick next);

  /// All faults by hand, in the order in which they began. `until_s` is empty while the end is not known.
  const std::vector<HandFault>& all() const { return faults_; }
  /// The faults that are in force in the exchange at this tick, or will be later.
  std::vector<HandFault> open(Tick tick) const;
  bool empty() const { return faults_.empty(); }
  /// Each as an entry of a fault file.
  std::vector<std::string> lines() const;
  /// Text of the fault file that repeats the run: the faults of its own fault file, then these.
  std::string file_text() const;

 private:
  std::string begin(const view::FaultOrder& order, Tick next);
  std::string end(std::uint64_t number, Tick next);
  std::string contradiction(const Fault& fault) const;
  std::string unreadable() const;

  const Scenario& scenario_;
  const std::vector<Fault> own_;
  std::vector<HandFault> faults_;
  std::uint64_t next_number_ = 0;
};

}  // namespace skein::sim
