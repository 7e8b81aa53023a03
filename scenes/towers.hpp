// The family `towers`: three tall towers that carry one long deck, a museum of petals beside them, and a small building
// at some distance. Size, fleet and starts are those of the benchmark's MBS scene; all shapes are original.
// Frame: W, ground z = 0.   Units: m.   Pure.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Builds one scene of the family. Sizes, angles, positions and relief depend on the seed alone.
/// Six boxes before variation: deck, three towers, museum, kiosk. 4,000 interest points, all inside the boxes.
UnsampledScene make_towers(std::uint64_t scene_seed);

}  // namespace skein::sim
