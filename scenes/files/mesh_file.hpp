// Triangles of a structure: from a file of any format that is accepted, and to STL. Frame W; metres.   Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "core/scenario/scene.hpp"

namespace skein::sim {

/// @param file  STL, unless its name has the extension of another format, in any case (model_file.hpp). STL is binary
///   or ASCII, detected by its content. Its normals are ignored (the benchmark's are zero), and its ASCII numbers are
///   exact to one unit in the last place.
/// @returns all triangles in the file's order, with three vertices each, which are not shared. Triangles without area
///   stay, so that the indices of the others do not change: no ray hits them, but a body may touch their edges.
/// @throws InputError with the file and the error: missing, not of its format, truncated, no triangles,
///   more than kMostTriangles, or a vertex that is not finite or has a coordinate beyond kFarthest.
TriangleMesh read_mesh(const std::filesystem::path& file);

/// The mesh as a binary STL: read_mesh() gives the same triangles, bit for bit and in the same order.
std::string to_stl(const TriangleMesh& mesh);

}  // namespace skein::sim
