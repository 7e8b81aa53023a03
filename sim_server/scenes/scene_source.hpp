// The scene that a scenario names: from files in CARIC's layout, or from a procedural family.
#pragma once

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim {

/// @throws InputError if a file is missing or malformed, or no family has the name; the message lists those that exist.
Scene load_scene(const Scenario& scenario);

}  // namespace skein::sim
