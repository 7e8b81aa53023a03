// Maps in time of a run that is over: what its agents kept in maps-<uav>.mcap (docs/results.md).
// Frame W.   Threads: one.   Bounded: kMostMapsRead snapshots a UAV; of more, some in between are left out.
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

/// One UAV's, of all files that its program left: one for each time that it was started. What a file that is cut off
/// lacks is missing.
/// @param height_m  of the UAV at a time: free space is shown there.
/// @returns nullopt when there are none, or a file is damaged.
std::optional<MapInTime> read_maps(const std::filesystem::path& dir, const std::string& uav,
                                   const std::function<double(double time_s)>& height_m);

/// Whether UAVs of a run have files with maps in time, all of them sound.
bool has_maps_in_time(const std::filesystem::path& dir, std::span<const std::string> uavs);

}  // namespace skein::view
