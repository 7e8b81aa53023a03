// Names, descriptions and start places of the families of procedural scenes. They are in core/ because every program
// may use them; scenes/ generates the structures, with one file for each family.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace skein {

/// A place on the ground where a UAV may start. Frame W; m, rad.
struct StartPlace {
  Vector2d p_W = Vector2d::Zero();
  double yaw = 0.0;
};

struct SceneFamily {
  const char* name;
  const char* description;
  std::vector<Vector2d> starts;  ///< with scene seed 0, in fleet order; no structure may be within 4 m of a start
};

/// All families, in the order in which they are listed to a user.
std::span<const SceneFamily> scene_families();
/// @returns nullptr when no family has this name.
const SceneFamily* find_scene_family(const std::string& name);

/// From this scene seed on, scenes vary in more respects: which UAV starts at which place, and loose or empty boxes.
inline constexpr std::uint64_t kVariedSeeds = 100;

/// Start places of a fleet in one scene of a family, in fleet order: with seed 0 the nominal places with yaw 0,
/// otherwise places up to 2 m from the nominal ones, with random yaw. From kVariedSeeds on the places are shuffled
/// among the UAVs; with one seed in four, all UAVs start close to one place, 1.45 m apart. Pure.
std::vector<StartPlace> scene_starts(const SceneFamily& family, std::uint64_t scene_seed);

}  // namespace skein
