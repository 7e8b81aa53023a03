// CARIC's box_description.yaml: the oriented boxes, which are all that a UAV knows in advance about the structures.
// Frame W; metres.   Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scenario/scene.hpp"

namespace skein::sim {

/// Each key is the name of a box with `center`, `size` and `orientation`, a row-major 4x4 matrix whose rotation R gives
/// p_W = R p_O + center. So R is R_WO, not its transpose: with R, the corners agree with those of the benchmark's
/// box*.stl within 0.1 mm; with the transpose, they are off by up to 49 m.
/// The translation of the matrix is ignored: for some of the benchmark's boxes it differs from `center`, and the
/// box*.stl agree with `center`.
/// @returns the boxes in the file's order. A rotation with an error of up to 0.001, as in files of single precision, is
///   made exactly orthonormal; one that is orthonormal except for rounding errors stays the same, bit for bit.
/// @throws InputError with file, line and key; for a matrix that is not a rotation, with the numbers that show this.
std::vector<OrientedBox> read_boxes(const std::filesystem::path& file);

/// The boxes as box_description.yaml, with enough digits that read_boxes() gives the same boxes, bit for bit.
/// @param boxes  their names become keys, and must be unique.
std::string to_box_description(const std::vector<OrientedBox>& boxes);

/// A box's surface as 12 triangles, for the box*.stl beside a box_description.yaml.
TriangleMesh box_surface(const OrientedBox& box);

}  // namespace skein::sim
