// The ropes, the hook and the load below a crane's trolley.   Frame: W.   Units: m.   Threads: any.
#pragma once

#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {

/// Appends ropes, a hook block with its hook, and a random load in slings: none, a container, a bundle of girders, or a
/// concrete bucket. It reaches at most 9 m below the block.
/// @param X_WT  frame of the trolley: the ropes go down from its origin.   @param drop  length of the ropes.
void add_hoist(MeshBuilder& builder, const Isometry3d& X_WT, double drop, RandomStream& random);

}  // namespace skein::sim
