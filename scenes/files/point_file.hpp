// Interest points, from and to PCD. Frame W; metres.   Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scenario/scene.hpp"

namespace skein::sim {

/// @param file PCD (ascii, binary or binary_compressed) with float fields x, y, z, normal_x, normal_y and
///   normal_z, of 4 or 8 bytes, in any order and among any others. VIEWPOINT is ignored: the coordinates are in W.
/// @returns the points in the file's order: all results identify a point by its index. Normals are scaled to unit
///   length; those of unit length stay the same, bit for bit.
/// @throws InputError with the file and the error: missing, not PCD, a field missing or of another type, truncated, no
///   points, more than kMostPoints, a number that is not finite, a coordinate beyond kFarthest, a normal of length 0.
std::vector<InterestPoint> read_points(const std::filesystem::path& file);

/// The points as a binary PCD with the fields, order and padding of the benchmark's files: read_points() gives the
/// same points, bit for bit.
std::string to_pcd(const std::vector<InterestPoint>& points);

}  // namespace skein::sim
