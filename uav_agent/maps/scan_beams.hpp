// What the beams of a scan tell a map. Frames: W world, L LiDAR.   Units: metres.   Pure.
#pragma once

#include <functional>
#include <vector>

#include "core/scenario.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// Whether the segment is known to be free.
using SegmentFree = std::function<bool(const Vector3d& a_W, const Vector3d& b_W)>;

/// All beams of which something is known. One without a return is free as far as the LiDAR reaches, but only where its
/// first `range_min_m` are known to be free already: the LiDAR is blind there, and what stands there may have swallowed
/// it. Beams that returned prove theirs themselves. One that met a UAV is free up to there and returned nothing.
///
/// The first proof: a UAV is put down where the space about it is clear, farther than its LiDAR is blind, and whoever
/// keeps the map says so (WorldMap::set_free()). From there on each new place has been proved from the ones before.
/// @param near_free  asked about the first `range_min_m` of a beam without return.
std::vector<Beam> map_beams(const BeamScan& scan, const LidarConfig& lidar, const SegmentFree& near_free);

}  // namespace skein::agent
