// The district: a site that grows with the fleet, for fleets of up to a thousand UAVs. It has a lot with one building
// for every five UAVs. The lots form a square with streets between them, where the UAVs start. The ground station
// stands on a mast in the middle. UAVs hear each other at short range only, so that the work of a UAV does not grow
// with the fleet; the station hears all UAVs in line of sight.
// Frame W.   Units: m, s.   Deterministic: the same numbers give the same bytes on every machine.   Threads: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "scenes/wild/world.hpp"

namespace skein::sim {

/// @param uavs  size of the fleet, at least 1.   @param config_dir  folder of the vehicles; empty: the default.
World draw_district(std::uint64_t scene_seed, std::size_t uavs, const std::filesystem::path& config_dir = {});

}  // namespace skein::sim
