// Intersection of a ray with shapes that need no search tree (ground, boxes, a UAV's body), and the distance between a
// point and a triangle.   Pure.   Frames: W world, B body.   Units: m.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sight/ray_scene.hpp"

namespace skein::sim {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Ray {
  Vector3d origin, direction;  ///< unit direction

  Vector3d at(double t) const { return origin + t * direction; }
};

/// Distance to the plane z = 0, from either side; infinity when the ray does not cross it.
inline double ground_distance(const Ray& ray) {
  return ray.origin.z() * ray.direction.z() < 0.0 ? -ray.origin.z() / ray.direction.z() : kInfinity;
}

/// Distance at which a ray enters a solid box that is centred at the frame's origin; 0 if the ray starts inside,
/// infinity if it misses the box.   @param half  half the edge lengths.
inline double box_distance(const Ray& ray, const Vector3d& half) {
  double enter = 0.0, leave = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0.0) {
      if (std::abs(o) > half[axis]) {
        return kInfinity;
      }
      continue;
    }
    const double a = (-half[axis] - o) / d, b = (half[axis] - o) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kInfinity;
}

/// Distance at which a ray crosses a triangle, from either side (Moeller and Trumbore 1997); infinity if it misses. All
/// in single precision: if the ray starts on the triangle's plane or crosses its edge, rounding decides.
inline float crossing_distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                               const std::array<Eigen::Vector3f, 3>& corners) {
  constexpr float kMissed = std::numeric_limits<float>::infinity();
  const Eigen::Vector3f edge1 = corners[1] - corners[0], edge2 = corners[2] - corners[0];
  const Eigen::Vector3f p = direction.cross(edge2);
  const float determinant = edge1.dot(p);
  if (determinant == 0.0F) return kMissed;
  const float inverse = 1.0F / determinant;
  const Eigen::Vector3f from_corner = origin - corners[0];
  const float u = from_corner.dot(p) * inverse;
  if (!(u >= 0.0F && u <= 1.0F)) return kMissed;
  const Eigen::Vector3f q = from_corner.cross(edge1);
  const float v = direction.dot(q) * inverse;
  if (!(v >= 0.0F && u + v <= 1.0F)) return kMissed;
  const float t = edge2.dot(q) * inverse;
  return t >= 0.0F ? t : kMissed;
}

/// Squared distance from a point to a triangle: to its plane if the foot of the perpendicular lies inside the triangle,
/// else to the nearest edge.
inline double squared_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto to_edge = [&p](const Vector3d& from, const Vector3d& to) {
    const Vector3d edge = to - from;
    const double length2 = edge.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp(edge.dot(p - from) / length2, 0.0, 1.0) : 0.0;
    return (p - from - s * edge).squaredNorm();
  };
  const Vector3d normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const bool inside = area2 > 0.0 && normal.dot((b - a).cross(p - a)) >= 0.0 &&
                      normal.dot((c - b).cross(p - b)) >= 0.0 && normal.dot((a - c).cross(p - c)) >= 0.0;
  if (inside) {
    const double height = normal.dot(p - a);
    return height * height / area2;
  }
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

/// A UAV's body at its present pose.
struct Body {
  BodyShape shape;
  double radius = 0.0;  ///< of a sphere about Bo that contains the whole shape
  std::array<Vector2d, 6> rotors;
  bool placed = false;  ///< whether it has a pose yet
  Isometry3d X_BW = Isometry3d::Identity();
  Vector3d p_WB = Vector3d::Zero();

  explicit Body(const BodyShape& s) : shape(s) {
    radius = std::max(0.5 * s.box_m.norm(), std::hypot(s.arm_m + s.rotor_radius_m, s.rotor_height_m));
    for (const BodyBox& link : s.links) radius = std::max(radius, link.p_B.norm() + 0.5 * link.edges_m.norm());
    for (std::size_t i = 0; i < rotors.size(); ++i) {
      const double angle = (30.0 + 60.0 * static_cast<double>(i)) * std::numbers::pi / 180.0;
      rotors[i] = s.arm_m * Vector2d(std::cos(angle), std::sin(angle));
    }
  }

  /// Distance of the first hit; infinity if the ray misses the body.
  double distance(const Ray& ray_W) const {
    const Ray ray{X_BW * ray_W.origin, X_BW.linear() * ray_W.direction};
    double nearest = box_distance(ray, 0.5 * shape.box_m);
    for (const BodyBox& link : shape.links) {
      nearest = std::min(nearest, box_distance({ray.origin - link.p_B, ray.direction}, 0.5 * link.edges_m));
    }
    const double t = (shape.rotor_height_m - ray.origin.z()) / ray.direction.z();
    if (std::isfinite(t) && t >= 0.0 && t < nearest) {
      const Vector2d crossing = ray.at(t).head<2>();
      for (const Vector2d& rotor : rotors) {
        if ((crossing - rotor).squaredNorm() <= shape.rotor_radius_m * shape.rotor_radius_m) {
          return t;
        }
      }
    }
    return nearest;
  }
};

}  // namespace skein::sim
