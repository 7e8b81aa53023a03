// The families of procedural scenes that a scenario may name: what every program may know of them. scenes/
// builds the structures, one file a family.
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
  std::vector<Vector2d> starts;  ///< of scene seed 0, in fleet order; nothing may be built within 4 m of one
};

/// All families, in the order in which they are listed to a user.
std::span<const SceneFamily> scene_families();
/// @returns nullptr when no family has this name.
const SceneFamily* find_scene_family(const std::string& name);

/// From this scene seed on, scenes differ in more than those before: who starts where, and boxes that are loose or
/// empty.
inline constexpr std::uint64_t kVariedSeeds = 100;

/// Where a fleet starts in one member of a family: with seed 0 its nominal places and yaw 0, otherwise places up to
/// 2 m from those, and any yaw. In fleet order. From kVariedSeeds on anybody may start at any of the places; with one
/// seed in four all crowd at one of them, 1.45 m apart. Pure.
std::vector<StartPlace> scene_starts(const SceneFamily& family, std::uint64_t scene_seed);

}  // namespace skein
