// Whether a UAV should interrupt its work now to deliver its captures.
//
// Let V be the score that would be lost with the UAV, h the rate at which UAVs are lost, g the score per second that
// its route gains, and d the duration of a flight to a link and back. If the UAV works on, and its captures are
// delivered after a further wait t, it loses h V t on average; the flight costs g d. So the flight pays if
//
//   h V t > g d.
//
// The captures wait until the last delivery of the mission at most. Earlier, the route may lead to a link. All that the
// UAV knows about this is how long its captures have waited, w; then the median of the further wait is w, too. So t is
// the lesser of w and the time until the last delivery. With steady work, V = g w, and the UAV delivers at intervals of
// sqrt(d / h), as a long computation saves its state. The least sum of both costs is at sqrt(2 d / h) (J. W. Young, A
// first order approximation to the optimum checkpoint interval, 1974); the sum at sqrt(d / h) is 6 % greater.
// Units: SI; values in points of score.   Pure.
#pragma once

#include "uav_agent/api/goals.hpp"

namespace skein::agent {

/// @param stake  V and g.   @param hazard_per_h  h, per hour.   @param wait_s  t.   @param detour_s  d.
inline bool delivery_pays(const Stake& stake, double hazard_per_h, double wait_s, double detour_s) {
  constexpr double kSecondsPerH = 3600.0;  // format
  return hazard_per_h / kSecondsPerH * stake.value * wait_s > stake.gain_per_s * detour_s;
}

}  // namespace skein::agent
