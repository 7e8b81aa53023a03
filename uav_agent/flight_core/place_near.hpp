// For a UAV that cannot or need not plan a path: finds the best of the places nearby to which it can fly straight.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <functional>
#include <optional>

#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

/// The best of 78 places at 1, 2 and 3 m from p_W, among those to which the safety filter lets the UAV fly straight.
/// If several places are equally good, it is the nearest of them.
/// @param p_W       the UAV's centre.
/// @param lowest_m  z in W below which no place lies.
/// @param least     only places of a higher value than this are worth the flight.
std::optional<Vector3d> best_place_near_W(const Vector3d& p_W, double lowest_m, double least,
                                          const std::function<double(const Vector3d& p_W)>& value, SafetyFilter& filter,
                                          const SafetyFilter::Facts& facts);

}  // namespace skein::agent
