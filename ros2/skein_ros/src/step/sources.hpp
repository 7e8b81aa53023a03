// The DDS participants at the other end, by the number that the lock-step knows them by, found through the rmw.
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

/// True where the node's rmw is Cyclone DDS's.
bool is_cyclonedds();

/// True for a sample that Cyclone DDS has sent to Fast DDS, where older samples come again that were meant for a reader
/// that has died.
bool may_be_repeated(const rmw_message_info_t& info);

/// The participant that wrote a sample.
class Writers {
 public:
  /// @returns 0 where the rmw does not tell.
  Source of(const rmw_subscription_t* subscription, const rmw_message_info_t& info);

 private:
  std::map<std::pair<const void*, std::uint64_t>, Source> known_;
};

/// The participant of the node's own publisher on a topic, by the node's name; 0 until the rmw knows it.
Source own_source(const rmw_node_t* node, const char* topic);

/// True once this endpoint has matched one of `source` on its topic, and all others that it can match.
bool has_matched(const rmw_node_t* node, const rmw_publisher_t* publisher, Source source);
bool has_matched(const rmw_node_t* node, const rmw_subscription_t* subscription, Source source);

/// True as long as the participant has a publisher on the topic.
bool publishes(const rmw_node_t* node, const char* topic, Source source);

}  // namespace skein_ros
