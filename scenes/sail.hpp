// The family `sail`: a tower shaped like a sail in the wind. A tall curved sheet with terraces on its convex side and a
// frame of booms and struts on its concave side; a podium below it, and a small sail at some distance.
// Frame: W, ground z = 0.   Units: m.   Pure.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Builds one scene of the family. Sizes, curvature, relief and positions depend on the seed alone.
/// Five boxes before variation: three along the height of the sail, podium, small sail. 4,000 interest points.
UnsampledScene make_sail(std::uint64_t scene_seed);

}  // namespace skein::sim
