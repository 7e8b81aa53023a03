// Trusses for procedural scenes: masts, jibs, girders and legs, welded from thin members.
// Frames: W world; L local to a truss, its z along the truss.   Units: m.
#pragma once

#include <span>
#include <vector>

#include "scenes/mesh_builder.hpp"

namespace skein::sim {

struct LatticeStyle {
  double chord = 0.2;    ///< thickness of the members that run along the truss
  double brace = 0.06;   ///< of those between them
  bool crossed = false;  ///< two diagonals a field, instead of one that alternates
};

/// A frame with its origin at `from` and its z towards `to`; its y is as near as can be to the world's up, or to the
/// world's y for a vertical truss. Pure.
Isometry3d frame_along(const Vector3d& from, const Vector3d& to);

/// Cross-sections at equal distances that pass evenly from one polygon into another with as many corners.
/// @param first, last  in the local xy plane.   @param length  along the local z.   @param fields  one less than rings.
std::vector<Ring> cross_sections(const Isometry3d& X_WL, const Polygon& first, const Polygon& last, double length,
                                 int fields);

/// Chords through the corners of cross-sections, a frame at each, and diagonals in every field between two.
/// @param rings  equally many corners each. Sides shorter than twice a brace are left out.
void add_lattice(MeshBuilder& builder, std::span<const Ring> rings, const LatticeStyle& style);

/// A railing along a straight edge: posts and two rails.
/// @param from, to  where the first and the last post stand.   @param up  towards the hand rail, of any length.
void add_railing(MeshBuilder& builder, const Vector3d& from, const Vector3d& to, const Vector3d& up);

}  // namespace skein::sim
