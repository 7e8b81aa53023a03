// A stepped tower on a wide podium.   Frame: W, ground z = 0.   Units: m.   Pure.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// A tower of about 120 m: tiers that step back, with fins, belts and balconies, a crown and a mast; around its foot a
/// podium with an arcade. Floor plan (rectangle, hexagon, octagon), steps, twist, crown, details, positions and boxes
/// vary with the seed; the starts and the space above them stay free (core/scenario/scene_families.cpp).
/// @param scene_seed  any; the same number gives the same bytes.
UnsampledScene make_spire(std::uint64_t scene_seed);

}  // namespace skein::sim
