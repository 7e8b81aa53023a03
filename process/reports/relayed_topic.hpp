// Report, about one topic, of a stand-in: the lock-step member that represents free-running ROS 2 nodes.
#pragma once

#include "process/reports/report_types.hpp"

namespace skein {

/// Numbers of messages from free-running ROS 2 nodes on a topic of their UAV (docs/ros2.md).
struct RelayedTopic {
  Text topic = {};      ///< ROS name
  Count received = {};  ///< all messages: handed on, lost, and refused as invalid
  Count handed_on = {};
  Count late = {};         ///< messages among those handed on whose stamp says that they are late
  Count lost = {};         ///< beyond the limit of one step, or received while the UAV's program was away
  Count refused = {};      ///< not valid for the topic's type, or handed on and rejected by sim_server
  Count other_clock = {};  ///< stamps that are not of simulated time
};
void describe(auto& f, RelayedTopic& relayed) {
  f.field("handed_on", relayed.handed_on);
  f.field("late", relayed.late);
  f.field("lost", relayed.lost);
  f.field("other_clock", relayed.other_clock);
  f.field("received", relayed.received);
  f.field("refused", relayed.refused);
  f.field("topic", relayed.topic);
}

}  // namespace skein
