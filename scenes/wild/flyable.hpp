// Whether a mission is possible in a drawn world: every start has a way out, and UAVs can reach and photograph a
// sufficient share of the points and deliver the pictures in time, estimated with straight lines and an allowance.
// Frame W.   Units: m, s.   Depends on nothing but its arguments; any thread.
#pragma once

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim::wild {

/// Uses the oracle's open space (open_space.hpp) with a clearance with which every vehicle fits. Each start must be
/// connected to it. At least five places in it must have line of sight to the station, which must not be enclosed. Of
/// some 160 points or more, a third must have a viewpoint in it with line of sight, at 0.85 d* (of the first UAV's
/// camera) or nearer. From a start to the viewpoint and on to a place with line of sight to the station, 1.5 times the
/// straight lines at 4 m/s plus 25 s must take less than half of the mission. Not considered: see docs/wild.md.
bool is_flyable(const Scenario& scenario, const Scene& scene);

}  // namespace skein::sim::wild
