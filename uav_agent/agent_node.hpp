// One UAV's on-board software as a process: topics in, one step of Agent, topics out. Joins its own domain only.
// Everything happens on the thread that calls run().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_loop.hpp"
#include "core/scenario.hpp"
#include "uav_agent/agent.hpp"
#include "uav_agent/radio_node.hpp"

namespace skein::agent {

class AgentNode {
 public:
  /// @param uav  index in fleet order.
  AgentNode(const Scenario& scenario, std::size_t uav, std::unique_ptr<Planner> planner, int base_domain,
            bus::Bus& bus);

  /// Takes part until the last step, or until asked to stop. @returns the program's exit code.
  int run(const StopSignal& stop);
  /// Makes run() look at `stop`; from any thread.
  void wake() { inbox_.wake(); }
  /// CPU time spent in the on-board software so far [s]; without transport.
  double planner_cpu_s() const { return planner_cpu_s_; }
  /// Samples received that were no message of their topic's type.
  std::uint64_t malformed() const { return inbox_.malformed(); }

 private:
  void join();
  template <class Message>
  void read(const topics::WireTopic& topic, bus::LockstepClient::Counterpart counterpart,
            std::function<void(const Message&)> handler);
  void read_sensors();
  void read_captures();
  void think();
  void write(const AgentOutput& output);

  const Scenario& scenario_;
  bus::Bus& bus_;
  const int domain_;
  const std::string id_;
  const Node node_;
  const RadioNode radio_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> participant_;
  std::optional<bus::LockstepClient> client_;
  Agent agent_;
  AgentInput input_;                     ///< being filled for the step to come
  std::vector<std::uint64_t> released_;  ///< acknowledged captures that the camera may forget
  bool last_step_answered_ = false;
  double planner_cpu_s_ = 0.0;
};

}  // namespace skein::agent
