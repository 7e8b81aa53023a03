// Trusses for procedural scenes: masts, jibs, girders and legs, made of thin members.
// Frames: W world; L local to a truss, with z along the truss.   Units: m.
#pragma once

#include <span>
#include <vector>

#include "scenes/mesh_builder.hpp"

namespace skein::sim {

struct LatticeStyle {
  double chord = 0.2;    ///< thickness of the members along the truss
  double brace = 0.06;   ///< thickness of the members between these
  bool crossed = false;  ///< two diagonals per field, instead of one that alternates
};

/// A frame with its origin at `from` and its z axis towards `to`. Its y axis is as close as possible to the world's up
/// direction, or to the world's y if the truss is steep. Pure.
Isometry3d frame_along(const Vector3d& from, const Vector3d& to);

/// Cross-sections at equal distances, interpolated linearly between two polygons with the same number of corners. Pure.
/// @param first, last  in the local xy plane.   @param length  along the local z.
/// @param fields  between the cross-sections: one less than their number.
std::vector<Ring> cross_sections(const Isometry3d& X_WL, const Polygon& first, const Polygon& last, double length,
                                 int fields);

/// Adds chords through the corners of the cross-sections, a frame of braces at each cross-section, and diagonals in
/// each field. Leaves out braces that are shorter than twice their thickness.
/// @param rings  the cross-sections, with the same number of corners each.
void add_lattice(MeshBuilder& builder, std::span<const Ring> rings, const LatticeStyle& style);

/// A railing along a straight edge: posts and two rails.
/// @param from, to  feet of the first and the last post.   @param up  direction of the posts, of any length.
void add_railing(MeshBuilder& builder, const Vector3d& from, const Vector3d& to, const Vector3d& up);

}  // namespace skein::sim
