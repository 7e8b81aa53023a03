// Who touches what, and how the many points of a physics engine become one contact for each pair.
// Frame W.   Units: SI.   Pure; safe from any thread.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace skein::sim {

/// What a UAV can touch.
struct BodyId {
  enum class Kind { ground, structure, uav };
  Kind kind = Kind::ground;
  UavIndex uav = {};  ///< fleet order; meaningful for Kind::uav only

  bool operator==(const BodyId&) const = default;
};

/// One UAV touches something; two UAVs that touch appear once, the lower number in `uav`.
struct Contact {
  UavIndex uav = {};
  BodyId other;
  Vector3d p_W = Vector3d::Zero();
};
/// At least one of the bodies is a UAV.
Contact contact_between(const BodyId& a, const BodyId& b, const Vector3d& p_W);

/// One of the points at which a pair touches.
struct ContactPoint {
  Contact contact;
  double distance = 0.0;  ///< of the two bodies there [m]; negative: they overlap
};
/// Sorted by UAV, then ground, structure and other UAVs; of each pair the point of least distance, of equal ones the
/// first.
std::vector<Contact> one_for_each_pair(std::vector<ContactPoint> points);

}  // namespace skein::sim
