// What hangs below a crane's trolley.   Frame: W.   Units: m.
#pragma once

#include "core/random_stream.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {

/// Two falls of rope, a hook block with its hook, and as the draw goes nothing, a container, a bundle of girders or a
/// concrete bucket in slings. At most 9 m of it hang below the block.
/// @param X_WT  frame of the trolley: ropes begin at its origin and go down.   @param drop  length of the ropes.
void add_hoist(MeshBuilder& builder, const Isometry3d& X_WT, double drop, RandomStream& random);

}  // namespace skein::sim
