// Reads the triangles of a structure from STL. Frame W; metres.
#pragma once

#include <cstddef>
#include <filesystem>

#include "core/scene.hpp"

namespace skein::sim {

inline constexpr std::size_t kMostTriangles = 5'000'000;  ///< of one file

/// @param file STL, binary or ASCII, by content. Normals are ignored (the benchmark's are zero).
/// @returns triangles in the file's order, three vertices each, not shared.
/// @throws InputError naming the file and what is wrong: missing, no STL, truncated, no triangles, too many, or a
///   vertex that is not finite.
TriangleMesh read_mesh(const std::filesystem::path& file);

}  // namespace skein::sim
