// Finds DDS participants through the rmw. Sources are the numbers by which the lock-step identifies them.
// Threads: the node's.
#pragma once

#include <rmw/rmw.h>
#include <rmw/topic_endpoint_info_array.h>

#include <cstdint>
#include <map>
#include <string>

namespace skein_ros {

/// FNV-1a (64 bit) over the 12 bytes of a participant's GUID prefix; 0: unknown.
using Source = std::uint64_t;

/// True if the node's rmw is rmw_cyclonedds_cpp.
bool is_cyclonedds();

/// True for a sample from Cyclone DDS if this node uses Fast DDS: then older samples may come again that were meant for
/// a reader that has died.
bool may_be_repeated(const rmw_message_info_t& info);

/// Finds the participant that wrote a sample.
class Writers {
 public:
  /// @returns 0 if the rmw does not tell
  Source of(const rmw_subscription_t* subscription, const rmw_message_info_t& info);

 private:
  std::map<std::pair<const void*, std::uint64_t>, Source> known_;
};

/// The participant of the node's own publisher on a topic, by the node's name; 0 until the rmw knows it.
Source own_source(const rmw_node_t* node, const char* topic);

/// True once this endpoint has matched every endpoint on its topic that it can match, and one of them is of `source`.
bool has_matched(const rmw_node_t* node, const rmw_publisher_t* publisher, Source source);
bool has_matched(const rmw_node_t* node, const rmw_subscription_t* subscription, Source source);

/// True while the participant has a publisher on the topic.
bool publishes(const rmw_node_t* node, const char* topic, Source source);

}  // namespace skein_ros
