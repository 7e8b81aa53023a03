#include "sim_server/flight/bullet_clearance.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein::sim {
namespace {

// Distance beyond a body's reach within which the nearest triangle is searched. If there is none, the body may fly this
// far without a test.
constexpr double kLookAround = 1.5;
// With less clearance than this, a search in nearly every tick would cost more than the test.
constexpr double kLeastRoom = 0.02;

double squared_distance_to_edge(const Vector3d& p, const Vector3d& from, const Vector3d& to) {
  const Vector3d edge = to - from;
  const double length2 = edge.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - from).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (p - from - share * edge).squaredNorm();
}

/// Finds the nearest of the triangles around a point.
struct Nearest final : btTriangleCallback {
  explicit Nearest(const Vector3d& the_p_W, double distance_max) : p_W(the_p_W), distance(distance_max) {}

  void processTriangle(btVector3* triangle, int, int) override {
    distance = std::min(distance,
                        distance_to_triangle(p_W, to_eigen(triangle[0]), to_eigen(triangle[1]), to_eigen(triangle[2])));
  }

  Vector3d p_W;
  double distance;
};

}  // namespace

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

double distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  // The projection of p is inside the triangle if p is on the inner side of all edges.
  const auto inside = [&](const Vector3d& from, const Vector3d& to) { return n.cross(to - from).dot(p - from) >= 0.0; };
  const double n2 = n.squaredNorm();
  if (n2 > 0.0 && inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(n.dot(p - a)) / std::sqrt(n2);
  return std::sqrt(std::min(
      {squared_distance_to_edge(p, a, b), squared_distance_to_edge(p, b, c), squared_distance_to_edge(p, c, a)}));
}

double clearance(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double distance_max) {
  Nearest nearest(p_W, distance_max);
  const btVector3 centre = to_bullet(p_W), reach(distance_max, distance_max, distance_max);
  mesh.processAllTriangles(&nearest, centre - reach, centre + reach);
  return nearest.distance;
}

bool ClearanceMemory::may_touch(const btBvhTriangleMeshShape& mesh, const Vector3d& p_W, double reach) {
  if (clear_at_W_ && to_bullet(*clear_at_W_).distance2(to_bullet(p_W)) < room_ * room_) return false;
  clear_at_W_.reset();
  room_ = clearance(mesh, p_W, reach + kLookAround) - reach;
  if (room_ > kLeastRoom) clear_at_W_ = p_W;
  // Tests once more after the body has left the mesh, so that Bullet drops its old contact points.
  return std::exchange(tested_, !clear_at_W_) || tested_;
}

}  // namespace skein::sim
