#include "tests/support/test_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/math/euler.hpp"
#include "scenes/files/mesh_file.hpp"
#include "scenes/files/point_file.hpp"

namespace skein::sim::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::array<Vector3d, 3> corners(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& index = mesh.triangles[triangle];
  return {mesh.vertices[index[0]].cast<double>(), mesh.vertices[index[1]].cast<double>(),
          mesh.vertices[index[2]].cast<double>()};
}

std::optional<std::filesystem::path> official_file(const std::string& file) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  return assets == nullptr ? std::nullopt : std::optional(std::filesystem::path(assets) / "models" / file);
}

double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - s * (b - a)).norm();
}

}  // namespace

void add_box(TriangleMesh& mesh, const Vector3d& centre, const Vector3d& size, const Matrix3d& R_WO) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    mesh.vertices.push_back((centre + R_WO * sign.cwiseProduct(size)).cast<float>());
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({base + f[0], base + f[1], base + f[2]});
    mesh.triangles.push_back({base + f[0], base + f[2], base + f[3]});
  }
}

TriangleMesh random_triangles(std::size_t count, std::uint64_t key) {
  RandomStream random(key, "random_triangles", 0, 0);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d first = random_in_box(random, {-20.0, -20.0, -20.0}, {20.0, 20.0, 20.0});
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(first.cast<float>());
    for (int k = 0; k < 2; ++k) {
      mesh.vertices.push_back((first + (0.5 + 9.5 * random.uniform()) * random_unit(random)).cast<float>());
    }
    mesh.triangles.push_back({base, base + 1, base + 2});
  }
  return mesh;
}

TriangleMesh every_nth_triangle(const TriangleMesh& mesh, std::size_t n) {
  TriangleMesh part;
  part.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += n) {
    part.triangles.push_back(mesh.triangles[i]);
  }
  return part;
}

std::optional<TriangleMesh> official_mesh(const std::string& file) {
  const auto path = official_file(file);
  return path ? std::optional(read_mesh(*path)) : std::nullopt;
}

std::optional<std::vector<InterestPoint>> official_points(const std::string& file) {
  const auto path = official_file(file);
  return path ? std::optional(read_points(*path)) : std::nullopt;
}

Matrix3d rotation(double roll, double pitch, double yaw) {
  return rotation_z(yaw) * rotation_y(pitch) * Eigen::AngleAxisd(roll, Vector3d::UnitX()).toRotationMatrix();
}

Vector3d random_in_box(RandomStream& random, const Vector3d& low, const Vector3d& high) {
  Vector3d p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = low[axis] + random.uniform() * (high[axis] - low[axis]);
  }
  return p;
}

Vector3d random_unit(RandomStream& random) {
  for (;;) {
    const Vector3d p = random_in_box(random, Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
    if (p.norm() > 0.1 && p.norm() <= 1.0) {
      return p.normalized();
    }
  }
}

BruteForceHit brute_force_distance(const TriangleMesh& mesh, const TestRay& ray, double distance_max, double edge) {
  BruteForceHit nearest{kInfinity};
  double nearest_uncertain = kInfinity;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = corners(mesh, i);
    const Vector3d p = ray.direction.cross(c - a);
    const double det = p.dot(b - a);
    const double slope = std::abs(det) / (b - a).cross(c - a).norm();  // sine of the angle between ray and plane
    if (!(slope > 1e-9)) {
      continue;
    }
    const Vector3d q = (ray.origin - a).cross(b - a);
    const double u = p.dot(ray.origin - a) / det, v = q.dot(ray.direction) / det, t = q.dot(c - a) / det;
    if (t < 0.0 || t > distance_max) {
      continue;
    }
    const Vector3d crossing = ray.origin + t * ray.direction;
    const double margin = std::min({distance_to_segment(crossing, a, b), distance_to_segment(crossing, b, c),
                                    distance_to_segment(crossing, c, a)});
    if (margin < edge / slope || t < edge / slope || t > distance_max - edge / slope) {
      nearest_uncertain = std::min(nearest_uncertain, t - edge / slope);
    }
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t < nearest.distance) {
      nearest.distance = t;
      nearest.tolerance = edge / slope;
    }
  }
  nearest.near_edge = std::isfinite(nearest_uncertain) && nearest_uncertain <= nearest.distance;
  return nearest;
}

double brute_force_clearance(const TriangleMesh& mesh, const Vector3d& p) {
  double nearest = kInfinity;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = corners(mesh, i);
    nearest =
        std::min({nearest, distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
    // The foot of the perpendicular counts if it lies inside the triangle: solves for it in the triangle's coordinates.
    Eigen::Matrix<double, 3, 2> basis;
    basis << b - a, c - a;
    const Vector2d uv = (basis.transpose() * basis).ldlt().solve(basis.transpose() * (p - a));
    if (uv.x() >= 0.0 && uv.y() >= 0.0 && uv.sum() <= 1.0) {
      nearest = std::min(nearest, (p - a - basis * uv).norm());
    }
  }
  return nearest;
}

std::string open_edges(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, opposite;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      opposite.emplace_back(t[(i + 1) % 3], t[i]);
    }
  }
  std::ranges::sort(edges);
  std::ranges::sort(opposite);
  if (std::ranges::adjacent_find(edges) != edges.end()) return "an edge is used twice in one direction";
  return edges == opposite ? "" : "an open edge";
}

std::string inward_parts(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> part(mesh.vertices.size());
  std::iota(part.begin(), part.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) part[root(t[1])] = part[root(t[2])] = root(t[0]);
  const auto corner = [&](std::uint32_t v) { return Vector3d(mesh.vertices[v].cast<double>()); };
  std::map<std::uint32_t, double> volume;  // positive for a part that is wound outwards
  for (const auto& t : mesh.triangles) {
    const std::uint32_t r = root(t[0]);
    const Vector3d a = corner(t[0]) - corner(r), b = corner(t[1]) - corner(r), c = corner(t[2]) - corner(r);
    volume[r] += a.dot(b.cross(c)) / 6.0;
  }
  std::ostringstream wrong;
  for (const auto& [r, v] : volume) {
    if (!(v > 0.0)) wrong << "the part at " << corner(r).transpose() << " has the volume " << v << "; ";
  }
  return wrong.str();
}

}  // namespace skein::sim::test
