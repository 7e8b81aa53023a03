// Reads OctoMap's .bt files, such as the map that each UAV saves at its end (run_folder::map_file). Any thread.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/files/octree_bytes.hpp"

namespace skein::results {

/// Calls `visit` with each leaf, in the order of the file.
/// @returns false if this is no such file, or an incomplete one; then `visit` may have received some leaves.
bool visit_octree_file(std::string_view file, const std::function<void(const KnownCube&)>& visit);

/// The contents of a file.
struct OctreeFile {
  std::string_view tree;  ///< bytes of the tree, for visit_octree(); a view into the file
  double cell_m = 0.0;    ///< edge of the smallest cells [m]
};
/// @returns nullopt if the text has no valid header of such a file.
std::optional<OctreeFile> octree_of_file(std::string_view file);

}  // namespace skein::results
