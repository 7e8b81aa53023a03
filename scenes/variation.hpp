// Varies the boxes of a procedural scene from seed to seed, in the same way for all families.
// The boxes are all that a planner knows in advance, and boxes that people draw by hand vary, too.
// Frame: W.   Units: m.   Threads: any.
#pragma once

#include <cstdint>

#include "core/math/random_stream.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

/// Changes the boxes of a scene, depending on its seed. Must be called before points are sampled inside the boxes.
/// Seed 0 keeps the boxes of the family. About one seed in four gives a single box around all of them, as in the
/// contest of 2024. With any other seed every box is turned a little about z and widened by up to 1 m on each side;
/// with some seeds two boxes are merged, or a long box is split. From kVariedSeeds (core/scenario/scene_families.hpp)
/// on, one box in three is also loose, with up to four times its volume, and three scenes in ten have an additional,
/// empty box. Every place in a box of the family is in a box afterwards.
/// @param scene  with at least one box; only its boxes change. Box axes should be turned about z only.
void vary_boxes(Scene& scene, std::uint64_t scene_seed);

/// Enlarges a box to at most four times its volume, and shifts it at random so that it still contains the old box.
void loosen(OrientedBox& box, RandomStream& random);

}  // namespace skein::sim
