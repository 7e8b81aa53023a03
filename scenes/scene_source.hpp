// The scene that a scenario names: from files in CARIC's layout, or from a procedural family.
#pragma once

#include <filesystem>
#include <optional>

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim {

/// @param cache  folder in which points of procedural families are kept (kept_points.hpp); nullopt: they are drawn.
/// @throws InputError if a file is missing or malformed, or no family has the name; the message lists those that exist.
Scene load_scene(const Scenario& scenario, const std::optional<std::filesystem::path>& cache = {});

}  // namespace skein::sim
