// The family `hangar`: an airliner that stands half inside an open hangar, nose or tail first. The hangar is a shell
// with columns and roof trusses, large enough to fly in.
// Frame: W, ground z = 0.   Units: m.   Pure.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Builds one scene of the family. The airliner's shape and pose, the hangar, and the work platforms beside the
/// airliner depend on the seed alone.
/// Seven boxes before variation: fuselage, two wings, tail, the hangar's front, its doors. 3,500 interest points.
UnsampledScene make_hangar(std::uint64_t scene_seed);

}  // namespace skein::sim
