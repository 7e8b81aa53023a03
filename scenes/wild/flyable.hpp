// Whether a drawn world can be flown at all: every start has a way out for its vehicle, and a good part of the points
// can be reached, seen and delivered in the time there is, by straight lines with an allowance.
// Frame W.   Units: m, s.   Depends on nothing but its arguments.
#pragma once

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim::wild {

/// By the oracle's free space (open_space.hpp) with a berth in which every vehicle fits: each start hangs together with
/// the open sky, the station can be seen from there, and of some 160 points at least a third have a place there from
/// which the first UAV's camera at 0.85 d* or nearer sees them, so near to any UAV's start and to a place that sees the
/// station that 1.5 times the straight lines take less than half of the mission. docs/wild.md says what it leaves out.
bool is_flyable(const Scenario& scenario, const Scene& scene);

}  // namespace skein::sim::wild
