// Reads CARIC's box_description.yaml: the oriented boxes that are all a UAV is told of the structures. Frame W;
// metres.
#pragma once

#include <filesystem>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

/// Each key names a box with `center`, `size` and `orientation`, a row-major 4x4 matrix whose rotation takes
/// the box's axes to the world: p_W = R p_O + center. That is R_WO as it stands, not its transpose: with it,
/// the corners of the benchmark's box*.stl come out within 0.1 mm, with the transpose they are up to 49 m off.
/// The matrix's translation is ignored: in some of the benchmark's boxes it differs from `center`, and the
/// box*.stl agree with `center`.
/// @returns the boxes in the file's order, their rotations made exactly orthonormal.
/// @throws InputError naming file, line and key.
std::vector<OrientedBox> read_boxes(const std::filesystem::path& file);

}  // namespace skein::sim
