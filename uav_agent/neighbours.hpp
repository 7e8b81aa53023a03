// Reads the neighbours' odometry as sim_server sends it: CARIC's PointCloud2, one point for each node in line of sight.
#pragma once

#include <vector>

#include "idl/conversions.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// Node number from the float field of a cloud's point; nullopt if it is not a valid whole number.
inline std::optional<Node> node_of(float number) {
  const auto node = whole_number(number);
  return node ? std::optional(Node(*node)) : std::nullopt;
}

/// Positions and velocities in W; the cloud has velocities in the neighbour's body frame.
inline std::vector<Neighbour> neighbours_of(const msg::PointCloud2& cloud) {
  std::vector<Neighbour> neighbours;
  for (const NeighbourPoint& p : from_cloud<NeighbourPoint>(cloud)) {
    const auto node = node_of(p.node);
    if (!node) continue;
    const Eigen::Quaterniond q_WB(p.qw, p.qx, p.qy, p.qz);
    neighbours.push_back({*node, Vector3d(p.x, p.y, p.z), Vector3d(q_WB * Vector3d(p.vx, p.vy, p.vz))});
  }
  return neighbours;
}

}  // namespace skein::agent
