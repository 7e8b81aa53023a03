// Interest points, from and to PCD. Frame W; metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

/// @param file PCD (ascii, binary or binary_compressed) with float fields x, y, z, normal_x, normal_y and
///   normal_z, of 4 or 8 bytes, in any order and among any others. VIEWPOINT is ignored: points are in W as they stand.
/// @returns the points in the file's order: their index is their name in every result. Normals are brought to unit
///   length; those that have it stay as they are, bit for bit.
/// @throws InputError naming the file and what is wrong: missing, no PCD, a field missing or of another type,
///   truncated, no points, more than kMostPoints, a number that is not finite, a point farther than kFarthest, a
///   normal of length zero.
std::vector<InterestPoint> read_points(const std::filesystem::path& file);

/// The points as a binary PCD with the fields, order and padding of the benchmark's files: read_points() gives the
/// same points, bit for bit.
std::string to_pcd(const std::vector<InterestPoint>& points);

}  // namespace skein::sim
