// Check model files before Assimp reads them, and write them in the simplest form with the same triangles. Assimp hangs
// or crashes on some damaged PLY files, recurses without a bound where nodes of a COLLADA file contain each other, and
// accepts words that are not numbers as numbers.
#pragma once

#include <filesystem>
#include <string>

namespace skein::sim {

/// Each function takes the file's content, and its path for messages, and returns the content of the simplest file.
/// Pure; any thread. @throws InputError naming the file, and the line if it is a text file with lines.

/// Only vertices and faces: no normals, texture coordinates, colours, groups, objects or materials.
std::string plain_obj(const std::filesystem::path& file, const std::string& bytes);

/// Binary, little-endian: vertices as floats, and the lists of vertices of the faces.
std::string plain_ply(const std::filesystem::path& file, const std::string& bytes);

/// Without materials, images, animations, lights, cameras and controllers.
std::string plain_dae(const std::filesystem::path& file, const std::string& bytes);

/// A .glb with nodes and meshes only, from a .glb or .gltf: positions as floats, and indices of 32 bits.
std::string plain_gltf(const std::filesystem::path& file, const std::string& bytes);

/// Greatest number of corners of a polygon: Assimp's time to divide it grows faster than this number.
inline constexpr std::size_t kMostCorners = 1000;
/// Greatest depth of the tree of nodes: Assimp's functions call themselves for each level.
inline constexpr std::size_t kDeepest = 100;
/// Greatest number of nodes, each instance counted.
inline constexpr std::size_t kMostNodes = 100'000;

}  // namespace skein::sim
