// Straight lines along which a body keeps its clearance from the structure.
// Frame W.   Units: m.   Pure; any thread.
#pragma once

#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Whether the clearance along a segment is at least `clearance` - `tolerance`. The tolerance lets a line begin and end
/// where a body just fits.   @param tolerance  > 0; also the least step between two samples of the clearance. Between
/// them, the line may pass an edge more closely by tolerance^2 / (8 (clearance - tolerance)): 1 mm for 1.4 m and 0.1 m.
bool is_clear_line(const RayScene& world, const Vector3d& a_W, const Vector3d& b_W, double clearance, double tolerance);

}  // namespace skein::sim
