// How far a point is from the triangles of a Bullet mesh: what a body cannot reach need not be tested for contacts.
// For physics_world.cpp; the header leaves Bullet's own out.
#pragma once

#include <optional>

#include "core/types.hpp"

class btBvhTriangleMeshShape;
class btVector3;

namespace skein::sim {

btVector3 to_bullet(const Vector3d& v);
Vector3d to_eigen(const btVector3& v);

/// Distance of the closest point of a triangle [m], in any position and also of a triangle without area. Pure.
double distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Distance of the closest point of a mesh, or `distance_max` when it is farther [m]. Pure.
double clearance(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double distance_max);

/// Says of one body, again and again as it moves, whether it has to be tested for contacts with a mesh. It remembers
/// how much room there was, and looks at the triangles anew only when that is used up.   Threads: one.
class ClearanceMemory {
 public:
  /// @param reach  of the body's contacts around `p_W`.
  /// @returns false if it touches nothing, and nothing is left in Bullet's memory of when it might have.
  bool may_touch(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double reach);
  /// The body is somewhere else now.
  void forget() { clear_at_W_.reset(); }

 private:
  std::optional<Vector3d> clear_at_W_;  ///< around here it cannot touch the mesh ...
  double room_ = 0.0;                   ///< ... as long as it is no farther away than this
  bool tested_ = false;                 ///< when last asked
};

}  // namespace skein::sim
