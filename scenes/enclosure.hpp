// Limits of where a UAV can be: whether the structure encloses a place, so that a UAV that starts there can never
// leave, and how far from the origin a UAV can get.   Frame: W.   Units: m.
#pragma once

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"
#include "core/types.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Looks for a way out: traces rays in all directions from the place, then from places close to the hits, and so on,
/// from up to 1000 places in each room. A room is all that is in sight of its first place. The structure need not be
/// closed or wound consistently.
/// Errs on the side of "not enclosed": any gap that a ray passes counts as a way out, even if no UAV fits through it,
/// and a maze of more than 30 rooms or 2000 places is not searched to its end.
/// Pure; safe from any thread. Takes some microseconds in the open, half a second in a hall, two seconds in a maze.
/// @param p_W  clear of the structure, above the ground.
/// @returns true if all rays from all places end at the structure or the ground.
bool is_enclosed(const RayScene& world, const Vector3d& p_W);

/// Upper limit of the distance of a UAV from the origin in a plausible flight: the farthest point of the structure, the
/// starts and the station, plus the distance that a fast UAV flies during the run, plus a margin. Pure.
double world_reach_m(const Scenario& scenario, const Scene& scene);

}  // namespace skein::sim
