// Where a UAV that stands still could go instead: another side, another height, a few metres off, by the rules of where
// it may fly or, when that has not helped, with less proof and less clearance.
// Frame W.   Units: m.   Pure; effort bounded by counts.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

/// Rules of the n-th attempt: each asks for less than the one before, but never lets a UAV nearer to anything mapped
/// than `least_clearance_m`, nor where no LiDAR looked.
FreeSpace::Config less_careful(FreeSpace::Config space, int attempt, double least_clearance_m);

/// Corners to a place some metres off, the first one that can be reached; nullopt if there is none. Attempts begin with
/// different directions.
/// @param structure  as for find_path().
std::optional<std::vector<Vector3d>> find_way_out(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                                  const Vector3d& from_W, int attempt);

}  // namespace skein::agent
