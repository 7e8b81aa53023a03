// What a stand-in for ROS 2 nodes reports of one topic.
#pragma once

#include "process/reports/report_types.hpp"

namespace skein {

/// What free-running ROS 2 nodes said on a topic of their UAV (docs/ros2.md), and what became of it.
struct RelayedTopic {
  Text topic = {};      ///< ROS name
  Count received = {};  ///< all of it: what was handed on, lost, and refused as no message
  Count handed_on = {};
  Count late = {};         ///< of those, by their stamp
  Count lost = {};         ///< more than a step can hold, or the UAV's program was away
  Count refused = {};      ///< no message of the topic's type, or handed on and rejected by sim_server
  Count other_clock = {};  ///< stamps that are not of simulated time
};
template <class Fields>
void describe(Fields& f, RelayedTopic& relayed) {
  f.field("handed_on", relayed.handed_on);
  f.field("late", relayed.late);
  f.field("lost", relayed.lost);
  f.field("other_clock", relayed.other_clock);
  f.field("received", relayed.received);
  f.field("refused", relayed.refused);
  f.field("topic", relayed.topic);
}

}  // namespace skein
