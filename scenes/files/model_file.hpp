// Triangles of a structure from OBJ, PLY, COLLADA and glTF files. Frame W (z up); metres.   Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/scenario/scene.hpp"

namespace skein::sim {

enum class ModelFormat { kObj, kPly, kDae, kGlb, kGltf };

/// @param extension  in lower case, with its dot. @returns nothing for all other extensions, also for ".stl".
std::optional<ModelFormat> model_format(std::string_view extension);

/// Reads the triangles only: not materials, textures, normals, points or lines. Opens no other file than this one.
/// Transformations of nodes are applied. COLLADA and glTF files say which axis is up, and COLLADA files their unit: the
/// coordinates are converted to z up and metres (y up becomes z up as (x, -z, y)). Those of OBJ and PLY files are taken
/// as they are.
/// @returns the triangles, with three vertices each, which are not shared: OBJ and PLY in the file's order, COLLADA and
///   glTF node by node (parents before their children) and, within a node, in the file's order. Polygons are divided.
/// @throws InputError with the file and the error: missing, larger than kMostModelBytes, malformed, in need of another
///   file or of an extension of the format that is not supported, no triangles, more than kMostTriangles, or a vertex
///   that is not finite or has a coordinate beyond kFarthest.
TriangleMesh read_model(const std::filesystem::path& file, ModelFormat format);

}  // namespace skein::sim
