// The family `sail`: a tower like a sail in the wind. A tall curved sheet with terraces on the convex side and a frame
// of booms and struts on the concave one; a podium below it, and a small sail apart.
// Frame: W, ground z = 0.   Units: m.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Builds one member of the family. Size, curvature, relief and where everything stands follow from the seed alone.
/// Five boxes before they vary: three up the sail, podium, small sail. 4,000 interest points.
UnsampledScene make_sail(std::uint64_t scene_seed);

}  // namespace skein::sim
