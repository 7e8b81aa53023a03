// Octrees as OctoMap serialises them in binary: what UAVs know of the space around them, in files of the kind .bt and
// in octomap_msgs/msg/Octomap. Read byte by byte, each checked, as the library does not: a damaged tree makes it read
// on without end. Frame W; metres. Any thread.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/types.hpp"

namespace skein {

/// A leaf of the tree. What none holds is unknown.
struct KnownCube {
  Vector3d lowest_W = Vector3d::Zero();
  double edge_m = 0.0;
  bool occupied = false;  ///< else free

  Vector3d middle_W() const { return lowest_W + Vector3d::Constant(0.5 * edge_m); }
};

/// Calls `visit` with each leaf of a tree, in its order.
/// @param cell_m  edge of its smallest cells.
/// @returns the number of its nodes; nullopt when it is not a whole tree, of which some leaves may have been visited.
std::optional<std::size_t> visit_octree(std::string_view bytes, double cell_m,
                                        const std::function<void(const KnownCube&)>& visit);

}  // namespace skein
