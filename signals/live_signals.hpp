// Values of the signals that the server knows during a run, for the conditions that faults wait for. run_signals.hpp
// says where everything about signals is.
// Threads: one.   Pure: knows no bus.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/expressions/signal_table.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/ids.hpp"
#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::signals {

/// What signals see of the world in the present exchange; sim_server/simulated_world.hpp implements it.
class LiveWorld {
 public:
  struct Uav {
    RigidBodyState state;
    double charge = 1.0;  ///< of its battery; 1: it is full, or the UAV has none
    bool alive = true;
  };

  virtual ~LiveWorld() = default;
  virtual Tick tick() const = 0;
  virtual Uav uav(UavIndex i) const = 0;
  /// Distance from a body's centre to the structure [m], kFarClearance_m at most.
  virtual double clearance(UavIndex i) const = 0;
  /// Whether the link is open: there is line of sight, and no blackout, outage or partition cuts it.
  virtual bool is_open(Node from, Node to) const = 0;
  virtual const std::vector<Fault>& faults() const = 0;
  /// The UAV of each capture that entered the ledger in this exchange.
  virtual std::vector<UavIndex> captures() const = 0;
};

class LiveSignals {
 public:
  /// Both must outlive this.
  LiveSignals(const Scenario& scenario, const LiveWorld& world);

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
  const LiveWorld& world_;
  std::map<std::string, Member> members_;
  std::vector<Captures> captures_;                               ///< by UAV
  std::map<std::pair<std::size_t, std::string>, double> debug_;  ///< by UAV and name
};

}  // namespace skein::signals
