// Upper limits for scenes. Files that exceed them are refused before memory is allocated.   Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types.hpp"

namespace skein::sim {

/// For all meshes together. Bullet's search tree has 21 bits for the index of a triangle; the limit is 30 times the
/// benchmark's largest scene. For the cost of such a scene see docs/scenarios.md.
inline constexpr std::size_t kMostTriangles = 2'000'000;
inline constexpr std::uintmax_t kMostBytes = 512u << 20;  ///< of one file; ASCII triangles have 268 each
/// Limit of one mesh file other than STL; the text of 2,000,000 triangles that share vertices has half of that size.
inline constexpr std::uintmax_t kMostModelBytes = 256u << 20;
inline constexpr std::size_t kMostPoints = 5'000'000;  ///< of one file
/// Greatest magnitude of a coordinate of a vertex, point or box [m]: single precision still resolves 8 mm there.
inline constexpr float kFarthest = 1e5F;

/// @throws InputError with the file's name and the reason.
[[noreturn]] inline void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(file.string() + ": " + why);
}

}  // namespace skein::sim
