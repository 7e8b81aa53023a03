// The faults of a run as the server has to do with them: when each begins and ends, which programs it takes out and
// lets back, and whether what a fault waits for has come.
// Threads: one.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bus/lockstep/server.hpp"
#include "process/status_lines.hpp"
#include "process/status_pipe.hpp"
#include "recording/replay.hpp"
#include "sim_server/live_signals.hpp"
#include "sim_server/process_faults.hpp"
#include "sim_server/record/fault_timeline.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class FaultNode {
 public:
  /// All must outlive this. @param replay  who takes part in a run that is flown again.
  FaultNode(const Scenario& scenario, Simulation& simulation, bus::LockstepServer& server, StatusPipe& status,
            const recording::ReplayOptions& replay);

  /// As a step begins. @returns what begins and ends with it, a line for people each.
  std::vector<std::string> begin_step();
  /// Before the step is published, which then tells the victims what to do.
  void take_out_victims();
  LiveSignals& signals() { return signals_; }
  /// When a step has been answered, and signals() know all of it: sets off what has waited for it.
  void end_step();
  /// At the boundary before the next step: who may come back.
  void let_back_victims();

  /// What has been set off so far.
  const std::vector<msg::FaultBegin>& begun() const { return begun_; }
  std::vector<FaultReport> report() const { return timeline_.report(); }
  /// Sentences for people, since the last call.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  void tell_order(const std::string& member, status::Order::What order, Tick tick);
  bool holds(const FaultCondition& when) const;

  Simulation& simulation_;
  bus::LockstepServer& server_;
  StatusPipe& status_;
  const recording::ReplayOptions& replay_;
  const Tick period_;
  LiveSignals signals_;
  FaultTimeline timeline_;
  ProcessFaults processes_;
  std::vector<msg::FaultBegin> begun_;
  std::vector<std::string> warnings_;
};

}  // namespace skein::sim
