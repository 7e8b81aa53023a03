// Inputs and outputs of the on-board software as structs with named fields. agent_node converts them from and to the
// messages on the wire, which follow CARIC's conventions.
// Frame W unless the name says otherwise.   Units: SI and radians.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// A radio node in line of sight in this exchange: a UAV or the ground station.
struct Neighbour {
  Node node = kStationNode;
  Vector3d p_W = Vector3d::Zero();
  std::optional<Vector3d> v_W = {};  ///< if known; otherwise Peers estimates it from positions
};

/// One LiDAR key frame, of this UAV or of a linked neighbour. The agent marks free space from it only if it knows the
/// sensor's position: the present position of `source`, or else `p_WS`, or else the position of the only linked UAV
/// with a LiDAR.
struct KeyFrame {
  std::vector<Eigen::Vector3f> points_W = {};  ///< hits
  std::optional<Vector3d> p_WS = {};           ///< position of the sensor, if known; agent_node does not set it
  std::optional<Node> source = {};             ///< node whose LiDAR made it, if the message says so
};

/// An interest point in one of this UAV's captures.
struct DetectedPoint {
  Eigen::Vector3f p_W = Eigen::Vector3f::Zero();
  double score = 0.0;       ///< this UAV's best quality of the point so far, [0, 1]
  std::uint32_t order = 0;  ///< 0, 1, 2, ... as this UAV first saw its points; other UAVs number them differently
  Eigen::Vector3f n_W = Eigen::Vector3f::Zero();  ///< unit normal of the surface, towards either side
};

/// One LiDAR scan of this UAV.
struct Scan {
  Tick tick = 0;                               ///< time stamp
  std::vector<Eigen::Vector3f> points_W = {};  ///< hits
};

/// A message between planners. The radio does not identify the sender: a planner that needs that puts it in the text.
struct RadioMessage {
  std::string topic;           ///< as declared in the scenario: "/broadcast"
  std::string text;            ///< content of a std_msgs/String; any bytes but NUL
  std::optional<Node> source;  ///< unused: agent_node cannot tell the sender
};

}  // namespace skein::agent
