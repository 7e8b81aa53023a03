// The faults of a run as the server has to do with them: when each begins and ends, which programs it takes out and
// lets back, whether what a fault waits for has come, and those that somebody who watches begins and ends.
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
#include "sim_server/hand_faults.hpp"
#include "sim_server/live_signals.hpp"
#include "sim_server/process_faults.hpp"
#include "sim_server/record/fault_timeline.hpp"
#include "sim_server/simulation.hpp"
#include "view/fault_order.hpp"
#include "view/story.hpp"

namespace skein::sim {

class FaultNode {
 public:
  /// All must outlive this. @param replay  who takes part in a run that is flown again. @param folder  of the run, for
  /// by-hand.yaml
  FaultNode(const Scenario& scenario, Simulation& simulation, bus::LockstepServer& server, StatusPipe& status,
            const recording::ReplayOptions& replay, const std::filesystem::path& folder);

  /// As a step begins. @returns what begins and ends with it, a line for people each; the log has them then.
  std::vector<std::string> begin_step();
  /// The same, for a page: of the last begin_step().
  struct Change {
    view::ToldFault fault;
    bool begins = false;
  };
  std::vector<Change> changes() const;
  /// Before the step is published, which then tells the victims what to do.
  void take_out_victims();
  LiveSignals& signals() { return signals_; }
  /// When a step has been answered, and signals() know all of it: sets off what has waited for it.
  void end_step();
  /// At the boundary before the next step: who may come back.
  void let_back_victims();
  /// At the boundary before the next step, who watches begins a fault with it, or ends one. Who may come back then is
  /// let back by let_back_victims(). @returns why not, for people; empty: it is done.
  std::string obey(const view::FaultOrder& order);

  /// What has been set off so far.
  const std::vector<msg::FaultBegin>& begun() const { return begun_; }
  /// Those by hand that somebody may end.
  std::vector<HandFault> open_by_hand() const { return hand_.open(simulation_.tick() + period_); }
  /// Those by hand so far, each as an entry of a fault file.
  std::vector<std::string> by_hand() const { return hand_.lines(); }
  std::vector<FaultReport> report() const;
  /// Sentences for people, since the last call.
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
  const std::size_t planned_;  ///< faults of the fault file
  LiveSignals signals_;
  FaultTimeline timeline_;
  ProcessFaults processes_;
  HandFaults hand_;
  std::vector<msg::FaultBegin> begun_;
  std::vector<std::string> warnings_;
};

}  // namespace skein::sim
