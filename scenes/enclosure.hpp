// Where a UAV can be: whether a place is shut in by the structure, so that a UAV that starts there can never leave, and
// how far away the world ends. Frame: W.  Units: m.
#pragma once

#include "core/scenario.hpp"
#include "core/scene.hpp"
#include "core/types.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Looks for a way out: in all directions from the place, then again from what could be seen from there, and so on.
/// The structure need not be closed or wound consistently. Errs on the side of "not enclosed": any gap that a ray
/// passes counts as a way out. Pure; safe from any thread. Some microseconds in the open, up to half a second inside.
/// @param p_W  clear of the structure, above the ground.
/// @returns true when every line of sight ends at the structure or the ground.
bool is_enclosed(const RayScene& world, const Vector3d& p_W);

/// How far from the origin a UAV can be that flies as UAVs do: beyond all that stands in the scene, the fleet's starts
/// and the station, as far as a fast one gets in the time of the run, with room to spare.
double world_reach_m(const Scenario& scenario, const Scene& scene);

}  // namespace skein::sim
