// Reads octrees (maps of a UAV) in OctoMap's binary serialisation with 16 levels: the data of octomap_msgs/msg/Octomap,
// and of .bt files after their header. Checks every byte, unlike OctoMap's own reader, which reads beyond the end of a
// damaged tree. Frame W; metres. Any thread.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/types.hpp"

namespace skein {

/// A leaf of the tree. Space that no leaf covers is unknown.
struct KnownCube {
  Vector3d lowest_W = Vector3d::Zero();  ///< corner with the least x, y and z
  double edge_m = 0.0;
  bool occupied = false;  ///< false: free

  Vector3d middle_W() const { return lowest_W + Vector3d::Constant(0.5 * edge_m); }
};

/// Calls `visit` with each leaf of a tree, in serialisation order.
/// @param cell_m  edge of the tree's smallest cells.
/// @returns the number of nodes, 0 for no bytes; nullopt when the bytes are not one whole tree: `visit` may then have
///   been called with some of its leaves.
std::optional<std::size_t> visit_octree(std::string_view bytes, double cell_m,
                                        const std::function<void(const KnownCube&)>& visit);

}  // namespace skein
