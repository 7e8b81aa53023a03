// Reads the maps over time of a finished run: the snapshots that its agents wrote to maps-<uav>.mcap (docs/results.md).
// Frame W.   Threads: one.   Bounded: at most kMostMapsRead snapshots per UAV, evenly picked, always with the last one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "view/map_steps.hpp"

namespace skein::view {

inline constexpr std::size_t kMostMapsRead = 240;

/// Reads all map files of one UAV: its program writes a new file at each start. Of a file that is cut off, the complete
/// snapshots count.
/// @param height_m  height of the UAV at a time: the level at which free space is shown.
/// @returns nullopt when there are no snapshots, or when a file is damaged.
std::optional<MapInTime> read_maps(const std::filesystem::path& dir, const std::string& uav,
                                   const std::function<double(double time_s)>& height_m);

/// Whether any of these UAVs has map files, and no map file of any of them is damaged.
bool has_maps_in_time(const std::filesystem::path& dir, std::span<const std::string> uavs);

}  // namespace skein::view
