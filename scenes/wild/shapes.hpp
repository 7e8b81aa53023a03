// The objects of wild scenes: structures of eleven kinds, and clutter. All shapes are random.
// Frames: W world; S of a structure: origin on the ground in the middle of its footprint, z up, x along it.
// Units: m.   Pure except for the stream.
#pragma once

#include <span>

#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim::wild {

/// Appends a structure. @param size  along the axes of S; some parts may reach a little beyond.
using AddStructure = void (*)(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random);

struct Kind {
  const char* name;
  AddStructure add;
  Vector3d least, most;  ///< limits of its proportions, length : width : height
};

/// Slabs with slots and windows, towers, stepped and leaning blocks, shells, tanks with pipes.
std::span<const Kind> solid_kinds();
/// Frames, lattices, roofs on columns, ships, bridges.
std::span<const Kind> open_kinds();

/// A tree of this height: a trunk and a dome as its crown.
void add_tree(MeshBuilder& builder, const Vector2d& p_W, double height, RandomStream& random);
/// Two poles with one to three sagging cables between them.
void add_cables(MeshBuilder& builder, const Vector2d& from_W, const Vector2d& to_W, double height,
                RandomStream& random);
/// A plate on four posts, open on all sides.
void add_canopy(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random);

/// A random integer from `least` to `most`, both included.
inline int draw_count(RandomStream& random, int least, int most) {
  return least + static_cast<int>(random.uniform() * (most - least + 1));
}

}  // namespace skein::sim::wild
