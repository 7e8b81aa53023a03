// Ways without sharp turns: corners are cut off twice, so that a UAV need not slow down for them.
// Frame W.   Units: metres.   Pure.
// Source: corner cutting, Chaikin 1974; where STAR has B-splines (Fast-Planner), this leaves the rest of the smoothing
// to the tracker (tracker.hpp).
#pragma once

#include <functional>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

using SegmentFree = std::function<bool(const Vector3d& a_W, const Vector3d& b_W)>;

/// @param corners_W  of the way that begins at `from_W`; the last one stays.
/// @param cut_m  a corner is cut off at most so far from it, and no farther than a third of the shorter leg.
/// @param free  asked of each short cut; a corner whose short cut is not free stays as it is.
std::vector<Vector3d> rounded(const Vector3d& from_W, const std::vector<Vector3d>& corners_W, double cut_m,
                              const SegmentFree& free);

}  // namespace skein::agent
