// A UAV's member of the lock-step on behalf of ROS 2 nodes that run freely in the UAV's DDS domain and know nothing of
// Skein. It relays their messages on the UAV's command and radio topics with the next step, and counts them. For runs
// in real time: no step waits for the nodes, so the same nodes may fly differently in each run (docs/how-to-ros2.md).
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
  /// @param debug_names  names of the values that the nodes publish on /<uav>/debug/<name>.
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
  bool was_away_ = false;  ///< it has rejoined, and has had no step since
};

}  // namespace skein::agent
