// One node's part in the radio topics of planners: the topics on which it may send and receive. Planners use only
// topics that carry text (std_msgs/String), as CARIC's do.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "bus/lockstep/client.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/scenario/scenario.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// Threads: only the one that dispatches the client's inbox.
class RadioNode {
 public:
  RadioNode(const Scenario& scenario, Node node);

  /// ROS names of the topics on which this node may send.
  const std::set<std::string>& topics() const { return out_; }
  /// Declares this node's writers and readers. Call it before client.start().
  /// @param received  arriving messages are appended to it; it must outlive the client.
  void declare(bus::LockstepClient& client, std::vector<RadioMessage>& received) const;
  /// Sends the messages on topics on which the scenario lets this node send; drops all others.
  void send(bus::LockstepClient& client, std::span<const RadioMessage> messages) const;

 private:
  NodeTopics node_topics_;  ///< those that carry text
  const std::size_t nodes_;
  std::set<std::string> out_;  ///< ROS topics
};

}  // namespace skein::agent
