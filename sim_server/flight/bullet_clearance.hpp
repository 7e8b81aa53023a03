// How far a point is from the triangles of a Bullet mesh: what a body cannot reach need not be tested for contacts.
// For physics_world.cpp; the header leaves Bullet's own out.
#pragma once

#include "core/types.hpp"

class btBvhTriangleMeshShape;
class btVector3;

namespace skein::sim {

Vector3d to_eigen(const btVector3& v);

/// Distance of the closest point of a triangle [m], in any position and also of a triangle without area. Pure.
double distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Distance of the closest point of a mesh, or `distance_max` when it is farther [m]. Pure.
double clearance(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double distance_max);

}  // namespace skein::sim
