// Maps as octomap_msgs/msg/Octomap, for an agent's topics and its files of snapshots.   Pure; any thread.
#pragma once

#include "core/types.hpp"
#include "idl/conversions.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

/// @param bytes  an octree in OctoMap's binary serialisation.
msg::Octomap octomap_of(const auto& bytes, double resolution_m, Tick tick) {
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
