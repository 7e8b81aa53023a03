// For the tests of the sensors: small meshes, random rays, and slow but obvious reference algorithms to intersect them.
// Frame W.   Units: m.
#pragma once

#include <optional>
#include <string>

#include "core/math/random_stream.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim::test {

struct TestRay {
  Vector3d origin, direction;  ///< unit direction
};

/// Appends a closed box of twelve triangles with shared corners.   @param size  full edge lengths.
void add_box(TriangleMesh& mesh, const Vector3d& centre, const Vector3d& size,
             const Matrix3d& R_WO = Matrix3d::Identity());

/// Unconnected triangles with edges of 0.5 to 10 m, within 20 m of the origin.
TriangleMesh random_triangles(std::size_t count, std::uint64_t key);

/// Every n-th triangle of a mesh, beginning with the first.
TriangleMesh every_nth_triangle(const TriangleMesh& mesh, std::size_t n);

/// Structure or interest points of the official data; nullopt if SKEIN_ASSETS is not set.
/// @param file  below the folder `models`, for example "mbs/mbs.stl".
std::optional<TriangleMesh> official_mesh(const std::string& file);
std::optional<std::vector<InterestPoint>> official_points(const std::string& file);

/// Rz(yaw) Ry(pitch) Rx(roll).
Matrix3d rotation(double roll, double pitch, double yaw);

Vector3d random_in_box(RandomStream& random, const Vector3d& low, const Vector3d& high);
Vector3d random_unit(RandomStream& random);

struct BruteForceHit {
  double distance;         ///< infinity: no hit
  double tolerance = 0.0;  ///< permitted deviation of a single-precision ray's hit
  bool near_edge = false;  ///< a ray that close to an edge may pass on either side
};

/// Distance to the first triangle on a ray: tests all triangles in double precision (Moeller and Trumbore's formulas).
/// @param edge  an intersection closer than this to an edge, seen along the ray, is uncertain.
BruteForceHit brute_force_distance(const TriangleMesh& mesh, const TestRay& ray, double distance_max, double edge);

/// Distance to the nearest triangle, by minimising over each triangle's plane and edges.
double brute_force_clearance(const TriangleMesh& mesh, const Vector3d& p);

/// Whether the mesh is closed: each edge is used once in each direction. @returns what is wrong; empty: nothing.
std::string open_edges(const TriangleMesh& mesh);

/// Whether all closed parts of the mesh, which share no vertices, are wound outwards. @returns what is wrong.
std::string inward_parts(const TriangleMesh& mesh);

}  // namespace skein::sim::test
