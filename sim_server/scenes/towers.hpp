// The family `towers`: three tall towers that carry one long deck, a museum of petals beside them and a small building
// apart. Of the size, and made for the fleet and the starts, of the benchmark's MBS scene; all shapes are our own.
// Frame: W, ground z = 0.   Units: m.
#pragma once

#include <cstdint>

#include "core/scene.hpp"

namespace skein::sim {

/// Builds one member of the family. Sizes, angles, positions and relief follow from the seed alone.
/// Six boxes: deck, three towers, museum, kiosk. Some 4,000 interest points, all inside the boxes.
/// The starts of the MBS fleet and its ground station, and the columns above them, are free by 3 m and more.
Scene make_towers(std::uint64_t scene_seed);

}  // namespace skein::sim
