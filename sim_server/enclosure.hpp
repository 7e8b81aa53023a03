// Whether a place is shut in by the structure: a UAV that starts there can never leave. Frame: W.  Units: m.
#pragma once

#include "core/types.hpp"
#include "sim_server/ray_scene.hpp"

namespace skein::sim {

/// Looks for a way out: in all directions from the place, then again from what could be seen from there, and so on.
/// The structure need not be closed or wound consistently. Errs on the side of "not enclosed": any gap that a ray
/// passes counts as a way out. Pure; safe from any thread. Some microseconds in the open, up to half a second inside.
/// @param p_W  clear of the structure, above the ground.
/// @returns true when every line of sight ends at the structure or the ground.
bool is_enclosed(const RayScene& world, const Vector3d& p_W);

}  // namespace skein::sim
