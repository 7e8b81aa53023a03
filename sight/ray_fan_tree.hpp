// The search tree of RayFan: eight children a branch, eight triangles a leaf, stored lane by lane.
// Frames: W world, T the tree's own axes, W turned about z.   Units: m.
#pragma once

#include <vector>

#include "core/scene.hpp"
#include "sight/ray_fan_job.hpp"

namespace skein::sim::fan {

struct Tree {
  std::vector<Branch> branches;  ///< the first one is the root; empty when there is no triangle
  std::vector<Leaf> leaves;
  Eigen::Matrix3f R_TW = Eigen::Matrix3f::Identity();
  float largest_coordinate = 0.0F;
};

/// Cuts long triangles into pieces with tight boxes, turns T to where boxes are tightest, then divides by surface area.
/// About 0.1 s per 100,000 triangles.
/// @param mesh  every triangle names vertices that exist. Triangles without area, or with one
///              that is no number in single precision, are left out.
Tree build_tree(const TriangleMesh& mesh);

}  // namespace skein::sim::fan
