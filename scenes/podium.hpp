// The podium of the spire: a wide low block with an arcade around it and objects on its roof.   Frame: W.   Units: m.
// Threads: any.
#pragma once

#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {

struct PodiumPlan {
  Isometry3d X_WP = Isometry3d::Identity();  ///< origin on the ground in the middle, x along the long side
  Vector2d size = Vector2d::Zero();
  double height = 0.0;                ///< of the roof
  Vector2d tower = Vector2d::Zero();  ///< where the tower stands, in P
  double tower_radius = 0.0;          ///< no other object stands on the roof within this distance of the tower
};

/// Appends the podium. Only the canopy over the entrance reaches beyond the plan's size: by up to 5 m, at y < 0.
void add_podium(MeshBuilder& builder, const PodiumPlan& plan, RandomStream& random);

}  // namespace skein::sim
