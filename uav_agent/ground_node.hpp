// A strategy's program at the ground station as a process (`uav_agent --role gcs`): topics in, one step of it, radio
// out. Joins the ground station's domain only. Everything happens on the thread that calls run().
#pragma once

#include <memory>
#include <optional>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_loop.hpp"
#include "core/scenario.hpp"
#include "uav_agent/ground_program.hpp"
#include "uav_agent/radio_node.hpp"

namespace skein::agent {

class GroundNode {
 public:
  GroundNode(const Scenario& scenario, std::unique_ptr<GroundProgram> program, int base_domain, bus::Bus& bus);

  /// Takes part until the last step, or until asked to stop. @returns the program's exit code.
  int run(const StopSignal& stop);
  /// Makes run() look at `stop`; from any thread.
  void wake() { inbox_.wake(); }
  /// CPU time spent in the strategy's program so far [s]; without transport.
  double planner_cpu_s() const { return planner_cpu_s_; }
  /// Samples received that were no message of their topic's type.
  std::uint64_t malformed() const { return inbox_.malformed(); }

 private:
  void join();
  void think();

  bus::Bus& bus_;
  const int domain_;
  const std::string id_;
  const RadioNode radio_;
  const std::unique_ptr<GroundProgram> program_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> participant_;
  std::optional<bus::LockstepClient> client_;
  GroundInput input_;  ///< being filled for the step to come
  bool last_step_answered_ = false;
  double planner_cpu_s_ = 0.0;
};

}  // namespace skein::agent
