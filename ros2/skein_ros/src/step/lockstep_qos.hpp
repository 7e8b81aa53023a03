// Quality of service of the lock-step's endpoints.
#pragma once

#include <rmw/error_handling.h>
#include <rmw/qos_profiles.h>
#include <rmw/rmw.h>

#include "sources.hpp"

namespace skein_ros {

/// RELIABLE, KEEP_LAST.
inline rmw_qos_profile_t reader_qos(int depth, bool latched) {
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.history = RMW_QOS_POLICY_HISTORY_KEEP_LAST;
  qos.depth = static_cast<std::size_t>(depth);
  qos.reliability = RMW_QOS_POLICY_RELIABILITY_RELIABLE;
  qos.durability = latched ? RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL : RMW_QOS_POLICY_DURABILITY_VOLATILE;
  return qos;
}

// For Cyclone DDS, reliable delivery begins at a writer's first heartbeat, and the heartbeat that Fast DDS sends at the
// match often comes too early. So with Fast DDS a heartbeat precedes each sample: it sends one to assert liveliness.

inline rmw_qos_profile_t writer_qos(int depth, bool latched) {
  rmw_qos_profile_t qos = reader_qos(depth, latched);
  if (!is_cyclonedds()) qos.liveliness = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC;
  return qos;
}

/// Call this before each sample of a publisher with writer_qos().
inline void send_heartbeat(const rmw_publisher_t* publisher) {
  if (!is_cyclonedds() && rmw_publisher_assert_liveliness(publisher) != RMW_RET_OK) rmw_reset_error();
}

}  // namespace skein_ros
