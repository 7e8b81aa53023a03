// Wild scenes: whole worlds drawn at random from one number. Structures, clutter, boxes, points, station, fleet,
// starts, resolution and time are all random (docs/wild.md).
// Frame W.   Units: m, s.   Deterministic: the same number gives the same bytes on every machine.   Threads: any.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

struct World {
  Scenario scenario;  ///< its scene has the family and the seed, but no files
  Scene scene;
  int attempt = 0;  ///< number of the first attempt that could be flown, from 0
};

/// Draws worlds until one can be flown (flyable.hpp).
/// @param family  of core/scenario/drawn_worlds.hpp.   @param config_dir  folder of the vehicles; empty: the default.
/// @throws InputError if the family is unknown; std::runtime_error if no world of 200 attempts can be flown.
World draw_world(const std::string& family, std::uint64_t scene_seed, const std::filesystem::path& config_dir = {});

}  // namespace skein::sim
