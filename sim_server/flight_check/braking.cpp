#include "sim_server/flight_check/braking.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/vectors.hpp"

namespace skein::sim {

double Braking::rest_s() const { return delay_s + v_W.norm() / deceleration_mps2; }

double Braking::way_m() const { return v_W.norm() * delay_s + v_W.squaredNorm() / (2.0 * deceleration_mps2); }

Vector3d Braking::at(double t_s) const {
  const double speed = v_W.norm();
  if (speed <= 0.0) return p_W;
  const double braking_s = std::clamp(t_s - delay_s, 0.0, speed / deceleration_mps2);
  const double way = speed * (std::min(t_s, delay_s) + braking_s) - 0.5 * deceleration_mps2 * braking_s * braking_s;
  return p_W + v_W * (way / speed);
}

double distance_of_segments(const Vector3d& from_a, const Vector3d& to_a, const Vector3d& from_b,
                            const Vector3d& to_b) {
  // Either an end of a segment is nearest, or two inner points whose connecting line is perpendicular to both segments.
  double least = std::min({distance_to_segment(from_a, from_b, to_b), distance_to_segment(to_a, from_b, to_b),
                           distance_to_segment(from_b, from_a, to_a), distance_to_segment(to_b, from_a, to_a)});
  const Vector3d a = to_a - from_a, b = to_b - from_b, n = a.cross(b), between = from_b - from_a;
  const double n2 = n.squaredNorm();
  if (n2 <= 0.0) return least;
  const double share_a = between.cross(b).dot(n) / n2, share_b = between.cross(a).dot(n) / n2;
  const bool inside = share_a >= 0.0 && share_a <= 1.0 && share_b >= 0.0 && share_b <= 1.0;
  return inside ? std::min(least, std::abs(between.dot(n)) / std::sqrt(n2)) : least;
}

Least least_distance(const Braking& a, const Braking& b, double most_m, double tolerance_m) {
  const double closing = std::max(a.v_W.norm() + b.v_W.norm(), 1e-9);
  const auto distance = [&](double t_s) { return (a.at(t_s) - b.at(t_s)).norm(); };
  return least_along(distance, std::max(a.rest_s(), b.rest_s()), closing, most_m, tolerance_m);
}

}  // namespace skein::sim
