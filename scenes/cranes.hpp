// A construction site: two tower cranes and a gantry crane, mostly lattice.
// Frame: W, ground z = 0.   Units: m.   Pure.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Two tower cranes of about 60 and 80 m with hammerhead jibs, and a gantry crane between them. The thinnest members
/// have 5 cm. Positions, sizes, headings of the jibs, positions of the trolleys, loads on the hooks, and boxes vary
/// with the seed; the starts and the space above them stay free (core/scenario/scene_families.cpp).
/// @param scene_seed  any; the same number gives the same bytes.
UnsampledScene make_cranes(std::uint64_t scene_seed);

}  // namespace skein::sim
