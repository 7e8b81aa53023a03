// The environment of a shell in which a user starts a UAV's ROS 2 nodes by hand: `eval "$(skein run --ros-env jurong)"`
// (docs/how-to-ros2.md).
#pragma once

#include <string>

#include "run/run_options.hpp"

namespace skein::cli {

/// DDS domain and neighbours of a UAV's nodes.
struct RosPlace {
  std::string uav;
  int domain = 0;
  std::string keys = {};                ///< key folder of the UAV's agent in a secured fleet; empty: not secured
  std::vector<std::string> peers = {};  ///< hosts on which other programs of that domain may run; empty: only this one
};

/// The place of the nodes of UAV options.ros_env: with --domain, in a fleet that is flown with these options; else in
/// the fleet that is flying now.
/// @throws InputError for a UAV that the fleet does not have, or when no fleet flies, or several
RosPlace ros_place(const RunOptions& options);

/// Shell lines that set the environment.
std::string shell_lines(const RosPlace& place);

inline std::string ros_environment(const RunOptions& options) { return shell_lines(ros_place(options)); }

}  // namespace skein::cli
