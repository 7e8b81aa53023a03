// Triangles of a structure, from and to STL. Frame W; metres.
#pragma once

#include <filesystem>
#include <string>

#include "core/scene.hpp"

namespace skein::sim {

/// @param file STL, binary or ASCII, by content. Normals are ignored (the benchmark's are zero). ASCII numbers are
///   read to one unit in the last place.
/// @returns all triangles in the file's order, three vertices each, not shared. Triangles without area stay, so that
///   the others keep their numbers: no ray meets them, but a body may touch their edges.
/// @throws InputError naming the file and what is wrong: missing, no STL, truncated, no triangles, more than
///   kMostTriangles, or a vertex that is not finite or farther than kFarthest.
TriangleMesh read_mesh(const std::filesystem::path& file);

/// The mesh as a binary STL: read_mesh() gives the same triangles, bit for bit and in the same order.
std::string to_stl(const TriangleMesh& mesh);

}  // namespace skein::sim
