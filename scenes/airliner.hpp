// A wide-body airliner of about 70 x 64 x 20 m on its wheels, as a part of scenes.
// Frames: W world; A airliner: origin on the ground below the tip of the nose, x aft, z up.   Units: m, rad.
// Threads: any.
#pragma once

#include <vector>

#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {

/// The parameters of an airliner's shape.
struct AirlinerShape {
  double length = 70.0, half_span = 32.0, height = 20.0;
  double radius = 3.0;       ///< of the fuselage
  double axis_height = 5.3;  ///< of the fuselage's straight part
  double sweep = 0.6;        ///< of the wings' leading edges
  double dihedral = 0.1;
  double wing_x = 24.0;  ///< where the leading edges meet the fuselage
  double root_chord = 13.0;
  bool four_engines = false;
};

/// Draws a shape; each of its numbers is within some percent of a real airliner's.
AirlinerShape draw_airliner(RandomStream& random);

/// Appends the airliner (fuselage, wings with engines, tail, wheels) as overlapping closed solids.
/// @returns its boxes: fuselage, each wing (aligned with the wing), tail.
std::vector<OrientedBox> add_airliner(MeshBuilder& builder, const Isometry3d& X_WA, const AirlinerShape& shape,
                                      double box_margin);

}  // namespace skein::sim
