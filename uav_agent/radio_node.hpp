// The radio topics on which planners talk: those that carry text (std_msgs/String), as CARIC's do. One node's share of
// them: what it may send on, what arrives at it.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "bus/lockstep/client.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/scenario.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// Used from the thread that dispatches the client's inbox.
class RadioNode {
 public:
  RadioNode(const Scenario& scenario, Node node);

  /// Topics that it may send on.
  const std::set<std::string>& topics() const { return out_; }
  /// Declares this node's topics, before client.start().
  /// @param received  takes what arrives; it must outlive the client.
  void declare(bus::LockstepClient& client, std::vector<RadioMessage>& received) const;
  /// Sends what the scenario lets this node send; anything else is left out.
  void send(bus::LockstepClient& client, std::span<const RadioMessage> messages) const;

 private:
  const std::vector<RadioRoute> routes_;
  const Node node_;
  const std::size_t nodes_;
  std::set<std::string> out_;  ///< ROS topics
};

}  // namespace skein::agent
