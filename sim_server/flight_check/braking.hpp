// Trajectories of braking bodies, and the distance between two of them. A body flies straight on at its velocity for a
// delay, and then brakes with constant deceleration. Frame W.   Units: SI.   Pure; safe from any thread.
#pragma once

#include "core/types.hpp"
#include "sim_server/flight_check/least_along.hpp"

namespace skein::sim {

/// The braking trajectory of a body's centre from now on.
struct Braking {
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();
  double delay_s = 0.0;            ///< until the body begins to brake
  double deceleration_mps2 = 1.0;  ///< above 0

  double rest_s() const;  ///< time from now until the body is at rest
  double way_m() const;   ///< distance flown until then
  Vector3d at(double t_s) const;
  Vector3d end_W() const { return at(rest_s()); }
};

/// Least distance between two segments [m]; also of segments of length 0.
double distance_of_segments(const Vector3d& from_a, const Vector3d& to_a, const Vector3d& from_b, const Vector3d& to_b);

/// Least distance between two centres while both brake [m], and its time [s]. @param most_m, tolerance_m  as `most` and
/// `tolerance` of least_along().
Least least_distance(const Braking& a, const Braking& b, double most_m, double tolerance_m);

}  // namespace skein::sim
