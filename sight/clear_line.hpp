// Straight lines along which a body keeps its distance from the structure.
// Frame W.   Units: m.   Pure; any thread.
#pragma once

#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Whether every place on a segment is at least `clearance` from the structure, but for `tolerance`: so that a line may
/// begin and end where a body just fits.   @param tolerance  > 0; the line is walked in no smaller steps.
bool is_clear_line(const RayScene& world, const Vector3d& a_W, const Vector3d& b_W, double clearance, double tolerance);

}  // namespace skein::sim
