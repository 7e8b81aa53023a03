// What reaches and leaves the on-board software, with every field named (on the wire CARIC's odd conventions apply;
// agent_node translates). Frame W unless the name says otherwise.   Units: SI and radians.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// A radio node in line of sight at this step; the station is among them when it is linked.
struct Neighbour {
  Node node = kStationNode;
  Vector3d p_W = Vector3d::Zero();
  std::optional<Vector3d> v_W = {};  ///< if it is known; else Peers takes it from successive positions
};

/// One LiDAR key frame, this UAV's own or a linked neighbour's. Free space is marked only if it can be told
/// where the sensor stood: from `source` and the positions of this step, else from `p_WS`, else if only one
/// linked UAV has a LiDAR.
struct KeyFrame {
  std::vector<Eigen::Vector3f> points_W = {};  ///< hits
  std::optional<Vector3d> p_WS = {};           ///< the sensor's position, if the message tells
  std::optional<Node> source = {};             ///< whose it is, this UAV's own node included, if the message tells
};

/// An interest point in one of this UAV's captures.
struct DetectedPoint {
  Eigen::Vector3f p_W = Eigen::Vector3f::Zero();
  double score = 0.0;       ///< best so far of this UAV, [0, 1]
  std::uint32_t order = 0;  ///< in which this UAV first saw it, 0, 1, 2, ...: its name for the point, and nobody else's
  Eigen::Vector3f n_W = Eigen::Vector3f::Zero();  ///< unit normal of the surface, to either side
};

/// One LiDAR scan of this UAV.
struct Scan {
  Tick tick = 0;                               ///< of its instant
  std::vector<Eigen::Vector3f> points_W = {};  ///< hits
};

/// A message between planners. Radio tells nobody who sent: whoever wants to be known says so in the text.
struct RadioMessage {
  std::string topic;           ///< as declared in the scenario, "/broadcast"
  std::string text;            ///< content of a std_msgs/String; any bytes but NUL
  std::optional<Node> source;  ///< of a received one, if agent_node can tell
};

}  // namespace skein::agent
