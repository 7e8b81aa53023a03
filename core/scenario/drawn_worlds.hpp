// Scenarios that are drawn whole from a scene seed: fleet, starts, station, resolution and time, too. No file of
// config/scenarios/ stands behind such a name: sim_server draws it (scenes/wild/world.hpp), and the launcher keeps
// what was drawn as an ordinary scenario with its files.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "core/scenario.hpp"

namespace skein {

inline constexpr const char* kBlindWorld = "wild_blind";  ///< nobody has a LiDAR: no clutter, walls or canopies
inline constexpr std::array<const char*, 2> kDrawnWorlds = {"wild", kBlindWorld};

/// To be raised with every change of what is drawn: worlds that were kept are drawn again.
inline constexpr int kWorldGrammar = 1;

/// Whether a scene is one of files. Those of a drawn world say which one it is: then there is a family, too.
inline bool from_files(const SceneConfig& scene) { return !scene.meshes.empty(); }

inline bool is_drawn_world(std::string_view name) {
  return std::ranges::find(kDrawnWorlds, name) != kDrawnWorlds.end();
}

}  // namespace skein
