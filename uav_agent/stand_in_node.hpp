// A UAV's place in the lock-step for ROS 2 nodes that run freely in its domain and know nothing of Skein: what they say
// on its topics for commands and radio is handed on with the next step, and counted. For runs in real time: no step
// waits for a node, so the same nodes may fly another flight each time (docs/ros2.md).
// Everything happens on the thread that drives it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "uav_agent/client/relay.hpp"
#include "uav_agent/client/user_node.hpp"

namespace skein::agent {

class StandInNode final : public UserNode {
 public:
  /// @param debug_names  of the values that nodes tell on /<uav>/debug/<name>.
  StandInNode(const Scenario& scenario, UavIndex uav, int base_domain, bus::Bus& bus,
              const std::vector<std::string>& debug_names);

  void start() override;
  std::optional<std::vector<RelayedTopic>> from_nodes() const override;

 private:
  void declare(bus::LockstepClient& client) override;
  bool may_think() override;
  void work(const bus::LockstepClient::Step& step) override;
  void count_rejections();

  const std::string uav_;
  std::vector<Relay> relays_;
  std::vector<std::unique_ptr<bus::Reader>> ears_;
  bool was_away_ = false;  ///< until its first step after it has come back
};

}  // namespace skein::agent
