// The family `hangar`: an airliner that stands half inside an open hangar, nose or tail first. The hangar is a shell
// with columns and roof trusses, wide enough to fly in.
// Frame: W, ground z = 0.   Units: m.
#pragma once

#include <cstdint>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// Builds one member of the family. The airliner's shape, how it stands, the hangar and the stands beside the airliner
/// follow from the seed alone.
/// Seven boxes before they vary: fuselage, two wings, tail, the hangar's front and its doors. 3,500 interest points.
UnsampledScene make_hangar(std::uint64_t scene_seed);

}  // namespace skein::sim
