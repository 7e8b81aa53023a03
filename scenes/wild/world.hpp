// Wild scenes: worlds that nobody has seen, drawn whole from one number: structures, clutter, boxes, points, station,
// fleet, starts, resolution and time (docs/wild.md). Not a building with variations but a grammar of them.
// Frame W.   Units: m, s.   Deterministic: the same number gives the same bytes, on every machine.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim {

struct World {
  Scenario scenario;  ///< its scene still names the family and its seed, and no files
  Scene scene;
  int attempt = 0;  ///< of the draw that could be flown; those before could not
};

/// Draws until a world can be flown (flyable.hpp).
/// @param family  of core/scenario/drawn_worlds.hpp.   @param config_dir  with the vehicles; empty: the usual one.
/// @throws InputError for a family that there is not.
World draw_world(const std::string& family, std::uint64_t scene_seed, const std::filesystem::path& config_dir = {});

}  // namespace skein::sim
