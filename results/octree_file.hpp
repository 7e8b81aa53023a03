// A .bt file of OctoMap's, read: the tree that each UAV leaves behind (run_folder::map_file). Any thread.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/files/octree_bytes.hpp"

namespace skein::results {

/// Calls `visit` with each leaf, in the order of the file.
/// @returns false for what is no such file, or not a whole one; some leaves may have been visited then.
bool visit_octree_file(std::string_view file, const std::function<void(const KnownCube&)>& visit);

/// What a file is about.
struct OctreeFile {
  std::string_view tree;  ///< as core/files/octree_bytes.hpp reads it; a part of the file
  double cell_m = 0.0;    ///< edge of its smallest cells
};
/// @returns nullopt for what does not begin as such a file does.
std::optional<OctreeFile> octree_of_file(std::string_view file);

}  // namespace skein::results
