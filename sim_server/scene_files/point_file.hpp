// Reads interest points from PCD. Frame W; metres.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

inline constexpr std::size_t kMostPoints = 5'000'000;  ///< of one file

/// @param file PCD (ascii, binary or binary_compressed) with float fields x, y, z, normal_x, normal_y and
///   normal_z in any order, among any others.
/// @returns the points in the file's order: their index is their name in every result. Normals have unit length.
/// @throws InputError naming the file and what is wrong: missing, no PCD, a field missing or of another type,
///   truncated, no points, a number that is not finite, a normal of length zero.
std::vector<InterestPoint> read_points(const std::filesystem::path& file);

}  // namespace skein::sim
