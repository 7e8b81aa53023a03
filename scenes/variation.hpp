// What every procedural family does alike once its structures stand: boxes that differ from seed to seed.
// A planner is told nothing but the boxes, and those who draw them by hand do not draw them alike.
// Frame: W.   Units: m.
#pragma once

#include <cstdint>

#include "core/random_stream.hpp"
#include "core/scene.hpp"

namespace skein::sim {

/// Redraws the boxes of a scene as its seed says; to be called before points are sampled inside them.
/// Seed 0 keeps the boxes of the family. One seed in four or so, drawn, gets a single box around all of them, as the
/// contest of 2024 had. With any other seed every box is turned a little about z and widened by up to 1 m a side; now
/// and then two neighbours become one box, or a long box becomes two. From kVariedSeeds
/// (core/scenario/scene_families.hpp) on one box in three is loose, too, up to four times its volume, and three scenes
/// in ten have one with nothing in it. Whatever lay in a box of the family lies in a box afterwards.
/// @param scene  with at least one box; only its boxes change. Box axes should be turned about z only.
void vary_boxes(Scene& scene, std::uint64_t scene_seed);

/// Widens a box, up to four times as much volume, and shifts it so that it holds what it held.
void loosen(OrientedBox& box, RandomStream& random);

}  // namespace skein::sim
