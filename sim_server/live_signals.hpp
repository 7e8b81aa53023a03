// Values of the signals (core/expressions/signal_table.hpp) that the server knows during a run, for the conditions that
// faults wait for. Readers of the run's folder get the same values later (signals/run_signals.hpp).
// Threads: one.   Pure: knows no bus.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/expressions/signal_table.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class LiveSignals {
 public:
  /// Both must outlive this.
  LiveSignals(const Scenario& scenario, const Simulation& simulation);

  /// Call it once per step, when the step is answered. @param is_member  whether the program of this name is a member.
  void end_step(const std::function<bool(const std::string&)>& is_member);
  /// The station's acknowledgement of a capture has reached this UAV.
  void add_release(UavIndex uav) { ++captures_.at(uav).released; }
  /// This UAV's program has published a debug value.
  void set_debug(UavIndex uav, const std::string& name, double value) { debug_[{uav, name}] = value; }
  /// @param signal  one that the table marks as live. @returns its value in this step, in the table's unit.
  double value(const SignalUse& signal) const;

 private:
  struct Member {
    bool present = false, was_present = false;
    int restarts = 0, leaves = 0;
  };
  struct Captures {
    double taken = 0.0, released = 0.0;
  };

  UavIndex uav_of(const SignalUse& signal, std::size_t place = 0) const;
  double of_uav(const SignalUse& signal) const;
  double separation(const SignalUse& signal) const;
  double clearance(const SignalUse& signal) const;
  double changes(const std::string& member, int Member::*kind) const;
  bool linked(const SignalUse& signal) const;
  double sum(const SignalUse& signal, const std::function<double(const Captures&)>& of) const;

  const Scenario& scenario_;
  const Simulation& simulation_;
  std::map<std::string, Member> members_;
  std::vector<Captures> captures_;                               ///< by UAV
  std::map<std::pair<std::size_t, std::string>, double> debug_;  ///< by UAV and name
};

}  // namespace skein::sim
