// Whoever steps a fleet in its process (one_process/session.hpp): the server shows each step, and ends none before it
// may.   Threads: one.
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

  /// A step is told to all. @param digest  of the steps before this one; it and the simulation live until closed().
  /// @param last  it is the run's last one.
  virtual void begin(const Simulation& simulation, const RunDigest& digest, bool last) = 0;
  /// Whether step k may end, once all have answered.
  virtual bool may_end(std::uint64_t k) const = 0;
  /// The last step has ended: `digest` is the run's.
  virtual void closed(const Simulation& simulation, const RunDigest& digest) = 0;
};

}  // namespace skein::sim
