// Tracks when each fault of a plan begins and ends in a run, for the log and for result.json. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "process/reports/reports.hpp"

namespace skein::sim {

class FaultTimeline {
 public:
  /// A fault of the plan, by its index there, that begins or ends.
  struct Change {
    std::size_t fault = 0;
    bool begins = false;
  };

  /// @param plan  must outlive this. Meanwhile the server may set off its faults that wait for a condition, append
  /// further faults, and give these an end.
  explicit FaultTimeline(const FaultPlan& plan) : faults_(plan.faults), entries_(plan.faults.size()) {}
  explicit FaultTimeline(FaultPlan&&) = delete;

  /// Call it once per exchange, in order, when the exchange begins.
  /// @returns a line for the log for each fault that begins or ends with this exchange, in the plan's order.
  std::vector<std::string> enter_step(std::uint64_t step, Tick tick);

  /// The faults that began or ended in the last enter_step().
  const std::vector<Change>& changes() const { return changes_; }

  /// One entry per fault, in the plan's order.
  std::vector<FaultReport> report() const;

 private:
  struct Entry {
    std::optional<std::uint64_t> began, ended;
  };

  const std::vector<Fault>& faults_;
  std::vector<Entry> entries_;  ///< by fault of the plan as of the last step
  std::vector<Change> changes_;
};

}  // namespace skein::sim
