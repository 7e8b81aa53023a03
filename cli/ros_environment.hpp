// What a shell needs in which ROS 2 nodes of a UAV are started by hand: `eval "$(skein run --ros-env jurong)"`
// (docs/ros2.md).
#pragma once

#include <string>

#include "cli/options.hpp"

namespace skein::cli {

/// Of a UAV's nodes.
struct RosPlace {
  std::string uav;
  int domain = 0;
  std::string keys = {};                ///< folder of the UAV's program in a secured fleet; empty: an open one
  std::vector<std::string> peers = {};  ///< hosts on which others of that domain may run; empty: this one alone
};

/// Where the nodes of options.ros_env belong: with --domain in a fleet that is flown with these options, else in the
/// one that flies now.
/// @throws InputError for a UAV that the fleet does not have, or when no fleet flies, or several
RosPlace ros_place(const RunOptions& options);

/// Lines for a shell.
std::string shell_lines(const RosPlace& place);

inline std::string ros_environment(const RunOptions& options) { return shell_lines(ros_place(options)); }

}  // namespace skein::cli
