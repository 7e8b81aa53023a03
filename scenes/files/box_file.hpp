// CARIC's box_description.yaml: the oriented boxes that are all a UAV is told of the structures. Frame W; metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

/// Each key names a box with `center`, `size` and `orientation`, a row-major 4x4 matrix whose rotation takes
/// the box's axes to the world: p_W = R p_O + center. That is R_WO as it stands, not its transpose: with it,
/// the corners of the benchmark's box*.stl come out within 0.1 mm, with the transpose they are up to 49 m off.
/// The matrix's translation is ignored: in some of the benchmark's boxes it differs from `center`, and the
/// box*.stl agree with `center`.
/// @returns the boxes in the file's order. A rotation that is off by up to 0.001, as files in single precision are, is
///   made exactly orthonormal; one that is orthonormal to rounding stays as it is, bit for bit.
/// @throws InputError naming file, line and key; a matrix that is no rotation with the numbers that show it.
std::vector<OrientedBox> read_boxes(const std::filesystem::path& file);

/// The boxes as box_description.yaml, with as many digits as it takes: read_boxes() gives the same boxes, bit for bit.
/// @param boxes  their names become keys and must differ.
std::string to_box_description(const std::vector<OrientedBox>& boxes);

/// A box's surface, 12 triangles: the box*.stl beside a box_description.yaml.
TriangleMesh box_surface(const OrientedBox& box);

}  // namespace skein::sim
