// The server's part in the faults of a run. It tracks when each fault begins and ends, takes out the programs that a
// fault kills or stops, lets them back, checks the conditions that faults wait for, and obeys a viewer who begins and
// ends faults by hand.
// Threads: one.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bus/lockstep/server.hpp"
#include "process/status/status_lines.hpp"
#include "process/status/status_pipe.hpp"
#include "recording/replay.hpp"
#include "signals/live_signals.hpp"
#include "sim_server/hand_faults.hpp"
#include "sim_server/process_faults.hpp"
#include "sim_server/record/fault_timeline.hpp"
#include "sim_server/simulated_world.hpp"
#include "sim_server/simulation.hpp"
#include "view/fault_order.hpp"
#include "view/story.hpp"

namespace skein::sim {

using signals::LiveSignals;

class FaultNode {
 public:
  /// All references but `folder` must outlive this. @param replay  says which members take part if a recorded run is
  /// flown again. @param folder  of the run; by-hand.yaml is written there.
  FaultNode(const Scenario& scenario, Simulation& simulation, bus::LockstepServer& server, StatusPipe& status,
            const recording::ReplayOptions& replay, const std::filesystem::path& folder);
  FaultNode(const FaultNode&) = delete;  // signals_ refers to world_
  FaultNode& operator=(const FaultNode&) = delete;

  /// Call it when a step begins. @returns a line for people for each fault that begins or ends with the step. It also
  /// writes these lines to the log.
  std::vector<std::string> begin_step();
  /// A fault that begins or ends, for the viewers' page.
  struct Change {
    view::ToldFault fault;
    bool begins = false;
  };
  /// The changes of the last begin_step().
  std::vector<Change> changes() const;
  /// Call it before the step is published: the step then carries the orders (kill, stop) to the programs concerned.
  void take_out_victims();
  LiveSignals& signals() { return signals_; }
  /// Call it when a step is answered and signals() has its values: sets off the faults whose condition now holds. They
  /// begin with the next step.
  void end_step();
  /// At the boundary before the next step: lets programs join again whose fault is over in that step.
  void let_back_victims();
  /// At the boundary before the next step: begins or ends a fault with that step, as a viewer asks. Call
  /// let_back_victims() afterwards. @returns why the order was refused, for people; empty: it was obeyed.
  std::string obey(const view::FaultOrder& order);

  /// The faults that waited for a condition and were set off so far.
  const std::vector<msg::FaultBegin>& begun() const { return begun_; }
  /// The faults by hand that a viewer may still end.
  std::vector<HandFault> open_by_hand() const { return hand_.open(simulation_.tick() + period_); }
  /// All faults by hand so far, each as an entry of a fault file.
  std::vector<std::string> by_hand() const { return hand_.lines(); }
  std::vector<FaultReport> report() const;
  /// Warnings for people since the last call, a sentence each.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  void tell_order(const std::string& member, status::Order::What order, Tick tick);
  bool holds(const FaultCondition& when) const;
  bool is_by_hand(std::size_t fault) const { return fault >= planned_; }

  Simulation& simulation_;
  bus::LockstepServer& server_;
  StatusPipe& status_;
  const recording::ReplayOptions& replay_;
  const std::filesystem::path folder_;
  const Tick period_;
  const std::size_t planned_;  ///< number of faults in the fault file
  const SimulatedWorld world_;
  LiveSignals signals_;
  FaultTimeline timeline_;
  ProcessFaults processes_;
  HandFaults hand_;
  std::vector<msg::FaultBegin> begun_;
  std::vector<std::string> warnings_;
};

}  // namespace skein::sim
