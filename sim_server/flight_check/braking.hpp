// How a body comes to rest, and how near that brings it to another one: straight on at its velocity for a while, then
// with constant deceleration. Frame W.   Units: SI.   Pure; safe from any thread.
#pragma once

#include "core/types.hpp"
#include "sim_server/flight_check/least_along.hpp"

namespace skein::sim {

/// The braking trajectory of a body's centre from now on.
struct Braking {
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();
  double delay_s = 0.0;            ///< until it begins to brake
  double deceleration_mps2 = 1.0;  ///< above 0

  double rest_s() const;  ///< from now on, until it stands
  double way_m() const;   ///< until it stands
  Vector3d at(double t_s) const;
  Vector3d end_W() const { return at(rest_s()); }
};

/// Least distance between two segments [m], whatever their lengths.
double distance_of_segments(const Vector3d& from_a, const Vector3d& to_a, const Vector3d& from_b, const Vector3d& to_b);

/// Least distance between two centres while both brake, and the time of it; see least_along().
Least least_distance(const Braking& a, const Braking& b, double most_m, double tolerance_m);

}  // namespace skein::sim
