// Distance of a point from the triangles of a Bullet mesh: a body that cannot reach the mesh need not be tested for
// contacts. For physics_world.cpp; does not include Bullet's headers.   Frame: W.   Units: m.
#pragma once

#include <optional>

#include "core/types.hpp"

class btBvhTriangleMeshShape;
class btVector3;

namespace skein::sim {

/// The same vector in Bullet's type, and in Eigen's.
btVector3 to_bullet(const Vector3d& v);
Vector3d to_eigen(const btVector3& v);

/// Distance of a point from a triangle [m]; also from a triangle without area. Pure.
double distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Distance of a point from a mesh [m]; `distance_max` if it is greater. Pure.
double clearance(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double distance_max);

/// Decides in each tick whether a moving body must be tested for contacts with a mesh. It remembers the body's last
/// clearance, and searches the triangles again only after the body has moved that far.   Threads: one.
class ClearanceMemory {
 public:
  /// @param p_W  the body's centre. @param reach  greatest distance from `p_W` at which the body can have contacts.
  /// @returns false if the body cannot touch the mesh and Bullet keeps no old contact points of the pair.
  bool may_touch(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double reach);
  /// Forgets the clearance. Call it when the body has been put elsewhere.
  void forget() { clear_at_W_.reset(); }

 private:
  std::optional<Vector3d> clear_at_W_;  ///< the body's centre at the last search; none: the body might touch the mesh
  double room_ = 0.0;                   ///< the body cannot touch the mesh within this distance of clear_at_W_ [m]
  bool tested_ = false;                 ///< whether the last search found that the body might touch the mesh
};

}  // namespace skein::sim
