// Scenarios that are generated completely from a scene seed, including fleet, starts, station, resolution and duration:
// wild scenes (scenes/wild/world.hpp), and the district, which also depends on the size of the fleet. There is no file
// in config/scenarios/ for such a name: sim_server generates the scenario, and the launcher stores it as an ordinary
// scenario with its files.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/scenario/scenario.hpp"

namespace skein {

inline constexpr const char* kBlindWorld = "wild_blind";  ///< no UAV has a LiDAR; without clutter, walls and canopies
inline constexpr std::array<const char*, 2> kWildWorlds = {"wild", kBlindWorld};
inline constexpr const char* kDistrict = "district";  ///< grows with the fleet (scenes/district.hpp)
/// UAVs of the district if no number is given.
inline constexpr std::size_t kUsualDistrictUavs = 20;

/// Increase this number with every change to the generator, so that stored worlds are generated again.
inline constexpr int kWorldGrammar = 1;

/// Whether a scene is loaded from files. The stored scene of a drawn world has both files and a family, the world's
/// name.
inline bool from_files(const SceneConfig& scene) { return !scene.meshes.empty(); }

inline bool is_drawn_world(std::string_view name) {
  return name == kDistrict || std::ranges::find(kWildWorlds, name) != kWildWorlds.end();
}

inline std::vector<std::string> drawn_world_names() {
  std::vector<std::string> names(kWildWorlds.begin(), kWildWorlds.end());
  names.emplace_back(kDistrict);
  return names;
}

}  // namespace skein
