// What a scene may have at most. Files with more are refused before memory is taken for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types.hpp"

namespace skein::sim {

/// Of all meshes together. Bullet's search tree numbers triangles with 21 bits; this is 30 times the benchmark's
/// largest scene. docs/scenarios.md says what such a scene costs.
inline constexpr std::size_t kMostTriangles = 2'000'000;
inline constexpr std::uintmax_t kMostBytes = 512u << 20;  ///< of one file; ASCII triangles have 268 each
inline constexpr std::size_t kMostPoints = 5'000'000;     ///< of one file
/// Of a vertex, point or box, in x, y and z [m]: there, single precision still resolves 8 mm.
inline constexpr float kFarthest = 1e5F;

[[noreturn]] inline void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(file.string() + ": " + why);
}

}  // namespace skein::sim
