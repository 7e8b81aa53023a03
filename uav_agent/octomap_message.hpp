// Maps as octomap_msgs/msg/Octomap: what an agent shows, and what it keeps.   Pure; any thread.
#pragma once

#include "core/types.hpp"
#include "idl/conversions.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

/// @param bytes  of a tree, as OctoMap serialises it.
template <class Bytes>
msg::Octomap octomap_of(const Bytes& bytes, double resolution_m, Tick tick) {
  msg::Octomap message;
  message.header(to_header(tick));
  message.binary(true);
  message.id("OcTree");
  message.resolution(resolution_m);
  message.data().assign(bytes.begin(), bytes.end());
  return message;
}

inline msg::Octomap octomap_of(const OccupancyMap& map, Tick tick) {
  return octomap_of(map.octomap_bytes(), map.config().resolution_m, tick);
}

}  // namespace skein::agent
