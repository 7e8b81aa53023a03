// The scene that a scenario names: from files in CARIC's layout, or from a procedural family.
// Frame: W.   Units: m.   Threads: any.
#pragma once

#include <filesystem>
#include <optional>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

/// @param cache  folder of cached points of procedural families (kept_points.hpp); nullopt: points are always sampled.
/// @throws InputError if a file is missing or malformed, or the family is unknown; the message lists all families.
Scene load_scene(const Scenario& scenario, const std::optional<std::filesystem::path>& cache = {});

}  // namespace skein::sim
