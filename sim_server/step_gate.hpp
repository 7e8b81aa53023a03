// Lets a process that contains the whole fleet step it (one_process/session.hpp): the server announces each step to the
// gate, and ends no step before the gate permits it.   Threads: one.
#pragma once

#include "sim_server/run_digest.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

class StepGate {
 public:
  StepGate() = default;
  StepGate(const StepGate&) = delete;
  StepGate& operator=(const StepGate&) = delete;
  virtual ~StepGate() = default;

  /// The server has published a step to all members. @param digest  of the steps before this one; it and the simulation
  /// live until closed(). @param last  whether it is the run's last step.
  virtual void begin(const Simulation& simulation, const RunDigest& digest, bool last) = 0;
  /// Whether step k may end once all members have answered it.
  virtual bool may_end(std::uint64_t k) const = 0;
  /// The run has ended: `digest` is that of the whole run.
  virtual void closed(const Simulation& simulation, const RunDigest& digest) = 0;
};

}  // namespace skein::sim
