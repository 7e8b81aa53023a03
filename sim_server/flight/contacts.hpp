// Contacts between bodies. Merges a physics engine's contact points into one contact for each pair of bodies.
// Frame W.   Units: SI.   Pure; safe from any thread.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace skein::sim {

/// A body that takes part in contacts: a UAV, or a thing that a UAV can touch.
struct BodyId {
  enum class Kind { ground, structure, uav };
  Kind kind = Kind::ground;
  UavIndex uav = {};  ///< fleet order; meaningful for Kind::uav only

  bool operator==(const BodyId&) const = default;
};

/// A UAV touches something. A contact of two UAVs appears once, with the lower index in `uav`.
struct Contact {
  UavIndex uav = {};
  BodyId other;
  Vector3d p_W = Vector3d::Zero();
};
/// Contact of two bodies, of which at least one must be a UAV.
Contact contact_between(const BodyId& a, const BodyId& b, const Vector3d& p_W);

/// One of the points at which a pair touches.
struct ContactPoint {
  Contact contact;
  double distance = 0.0;  ///< between the two bodies at this point [m]; negative: they overlap
};
/// One contact for each pair: at its point of least distance, and of equal ones the first. Sorted by UAV, then by
/// ground, structure and other UAVs.
std::vector<Contact> one_for_each_pair(std::vector<ContactPoint> points);

}  // namespace skein::sim
