// A construction site: two tower cranes and a gantry crane, mostly lattice.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Two tower cranes of about 60 and 80 m with hammerhead jibs, and a gantry crane between them. Members go down to
/// 5 cm. Places, sizes, the headings of the jibs, the places of the trolleys, what hangs on the hooks and the boxes
/// vary with the seed; starts and columns above them stay free (core/scenario/scene_families.cpp).
/// @param scene_seed  any; the same number gives the same bytes.
UnsampledScene make_cranes(std::uint64_t scene_seed);

}  // namespace skein::sim
