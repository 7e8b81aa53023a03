// Rounds the corners of a path, in two passes, so that a UAV need not slow down for them.
// Frame W.   Units: metres.   Pure.
// Source: corner cutting, Chaikin 1974, in place of STAR's B-splines (Fast-Planner). The tracker (tracker.hpp) does the
// rest of the smoothing.
#pragma once

#include <functional>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

using SegmentFree = std::function<bool(const Vector3d& a_W, const Vector3d& b_W)>;

/// @param corners_W  corners of the path that begins at `from_W`; the last one stays.
/// @param cut_m  greatest distance of a cut from its corner; it is also at most a third of the shorter leg.
/// @param free  called for each cut; a corner whose cut is not free stays. So does a turn of less than 18 degrees.
std::vector<Vector3d> rounded(const Vector3d& from_W, const std::vector<Vector3d>& corners_W, double cut_m,
                              const SegmentFree& free);

}  // namespace skein::agent
