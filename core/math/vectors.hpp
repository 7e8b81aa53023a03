// Distances and lengths of vectors.   Units are the caller's. Pure.
#pragma once

#include <algorithm>

#include "core/types.hpp"

namespace skein {

/// Distance of a point from the segment between `a` and `b`, which may be one point.
template <class Vector>
double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector ab = b - a;
  const double length2 = ab.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (a + share * ab - p).norm();
}

/// A vector of the same direction, no longer than `length`.
inline Vector3d shortened(const Vector3d& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vector3d(v * (length / norm)) : v;
}

}  // namespace skein
