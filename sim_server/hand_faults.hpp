// Faults that somebody who watches a run begins and ends: each from the next exchange on, so that a fault file can say
// the same. What such a file could not say is refused.
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
  std::uint64_t number = 0;  ///< by which it is ended
  Fault fault;
};

class HandFaults {
 public:
  /// @param scenario  must outlive this. @param own  those of the run's fault file, as it was read.
  HandFaults(const Scenario& scenario, const FaultPlan& own);

  /// @param next  tick of the exchange that begins next: what it asks for holds from then on.
  /// @returns why not, for people; empty: it is done.
  std::string obey(const view::FaultOrder& order, Tick next);

  /// In the order in which they began; until_s is no more than what is known so far.
  const std::vector<HandFault>& all() const { return faults_; }
  /// Those that are in force in the exchange at this tick, or will be.
  std::vector<HandFault> open(Tick tick) const;
  bool empty() const { return faults_.empty(); }
  /// Each as an entry of a fault file.
  std::vector<std::string> lines() const;
  /// The fault file with which the run is flown again: its own faults first.
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
