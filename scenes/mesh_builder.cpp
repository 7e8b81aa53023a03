#include "scenes/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

/// Two unit vectors that complete an axis to a right-handed frame (u, v, axis).
std::pair<Vector3d, Vector3d> frame_about(const Vector3d& axis) {
  const Vector3d helper = std::abs(axis.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d u = helper.cross(axis).normalized();
  return {u, axis.cross(u)};
}

Ring ring_at(const Isometry3d& X_WL, const Polygon& polygon, double z) {
  Ring ring;
  for (const Vector2d& p : polygon) ring.push_back(X_WL * Vector3d(p.x(), p.y(), z));
  return ring;
}

Vector3d centre(const Ring& ring) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : ring) sum += p;
  return sum / static_cast<double>(ring.size());
}

}  // namespace

Polygon regular_polygon(int corners, double radius, double phase) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = phase + 2.0 * std::numbers::pi * i / corners;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

Polygon rectangle(const Vector2d& center, const Vector2d& size, double chamfer) {
  const Vector2d h = 0.5 * size;
  const double x0 = center.x() - h.x(), x1 = center.x() + h.x(), y0 = center.y() - h.y(), y1 = center.y() + h.y();
  if (chamfer <= 0.0) return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  const double c = chamfer;
  return {{x0 + c, y0}, {x1 - c, y0}, {x1, y0 + c}, {x1, y1 - c},
          {x1 - c, y1}, {x0 + c, y1}, {x0, y1 - c}, {x0, y0 + c}};
}

Isometry3d standing_at(const Vector2d& p_W, double heading) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() << p_W, 0.0;
  X.linear() = rotation_z(heading);
  return X;
}

std::uint32_t MeshBuilder::add_vertex(const Vector3d& p) {
  mesh_.vertices.push_back(p.cast<float>());
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh_.triangles.push_back({a, b, c});
}

void MeshBuilder::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  add_triangle(a, b, c);
  add_triangle(a, c, d);
}

void MeshBuilder::add_loft(std::span<const Ring> rings, const std::optional<Vector3d>& first_apex,
                           const std::optional<Vector3d>& last_apex) {
  if (rings.size() < 2) throw std::invalid_argument("a loft needs two rings");
  const std::size_t n = rings.front().size();
  if (n < 3) throw std::invalid_argument("a loft's ring needs three corners");
  for (const Ring& ring : rings) {
    if (ring.size() != n) throw std::invalid_argument("a loft's rings must have equally many corners");
  }

  const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (const Ring& ring : rings) {
    for (const Vector3d& p : ring) add_vertex(p);
  }
  const auto corner = [&](std::size_t ring, std::size_t i) {
    return base + static_cast<std::uint32_t>(ring * n + i % n);
  };
  for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (std::size_t i = 0; i < n; ++i) {
      add_quad(corner(ring, i), corner(ring, i + 1), corner(ring + 1, i + 1), corner(ring + 1, i));
    }
  }
  const std::uint32_t first = add_vertex(first_apex.value_or(centre(rings.front())));
  const std::uint32_t last = add_vertex(last_apex.value_or(centre(rings.back())));
  for (std::size_t i = 0; i < n; ++i) {
    add_triangle(first, corner(0, i + 1), corner(0, i));
    add_triangle(last, corner(rings.size() - 1, i), corner(rings.size() - 1, i + 1));
  }
}

void MeshBuilder::add_sheet(std::span<const Ring> front, std::span<const Ring> back) {
  const std::size_t rows = front.size(), columns = rows == 0 ? 0 : front[0].size();
  if (rows < 2 || columns < 2) throw std::invalid_argument("a sheet needs two rows and two columns");
  const auto fits = [&](const Ring& row) { return row.size() == columns; };
  if (back.size() != rows || !std::ranges::all_of(front, fits) || !std::ranges::all_of(back, fits)) {
    throw std::invalid_argument("a sheet's rows must have equally many points");
  }

  const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
  const auto other_side = static_cast<std::uint32_t>(rows * columns);
  for (const auto& side : {front, back}) {
    for (const Ring& row : side) {
      for (const Vector3d& p : row) add_vertex(p);
    }
  }
  const auto at = [&](std::size_t row, std::size_t column) {
    return base + static_cast<std::uint32_t>(row * columns + column);
  };
  for (std::size_t r = 0; r + 1 < rows; ++r) {
    for (std::size_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t quad[] = {at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)};
      add_quad(quad[0], quad[1], quad[2], quad[3]);
      add_quad(quad[3] + other_side, quad[2] + other_side, quad[1] + other_side, quad[0] + other_side);
    }
  }
  std::vector<std::uint32_t> rim;  // once around, in the front's winding
  for (std::size_t c = 0; c + 1 < columns; ++c) rim.push_back(at(0, c));
  for (std::size_t r = 0; r + 1 < rows; ++r) rim.push_back(at(r, columns - 1));
  for (std::size_t c = columns - 1; c > 0; --c) rim.push_back(at(rows - 1, c));
  for (std::size_t r = rows - 1; r > 0; --r) rim.push_back(at(r, 0));
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t from = rim[i], to = rim[(i + 1) % rim.size()];
    add_quad(to, from, from + other_side, to + other_side);
  }
}

void MeshBuilder::add_prism(const Isometry3d& X_WL, const Polygon& polygon, double z0, double z1) {
  const Ring rings[] = {ring_at(X_WL, polygon, z0), ring_at(X_WL, polygon, z1)};
  add_loft(rings);
}

void MeshBuilder::add_box(const Isometry3d& X_WL, const Vector3d& size) {
  add_prism(X_WL, rectangle(Vector2d::Zero(), size.head<2>()), -0.5 * size.z(), 0.5 * size.z());
}

void MeshBuilder::add_cylinder(const Vector3d& from, const Vector3d& to, double radius, int sides) {
  const Vector3d axis = (to - from).normalized();
  const auto [u, v] = frame_about(axis);
  Isometry3d X_WL = Isometry3d::Identity();
  X_WL.linear() << u, v, axis;
  X_WL.translation() = from;
  add_prism(X_WL, regular_polygon(sides, radius), 0.0, (to - from).norm());
}

void MeshBuilder::add_member(const Vector3d& from, const Vector3d& to, double thickness) {
  add_cylinder(from, to, thickness / std::numbers::sqrt2, 4);
}

void MeshBuilder::add_dome(const Isometry3d& X_WL, const Vector3d& half_axes, double z0, int sides, int levels) {
  const double bottom = std::asin(z0 / half_axes.z());  // latitude of the cut
  std::vector<Ring> rings;
  for (int level = 0; level < levels; ++level) {
    const double latitude = bottom + (0.5 * std::numbers::pi - bottom) * level / levels;
    Polygon polygon = regular_polygon(sides, std::cos(latitude));
    for (Vector2d& p : polygon) p = p.cwiseProduct(half_axes.head<2>());
    rings.push_back(ring_at(X_WL, polygon, half_axes.z() * std::sin(latitude)));
  }
  add_loft(rings, std::nullopt, X_WL * Vector3d(0, 0, half_axes.z()));
}

void append(TriangleMesh& all, const TriangleMesh& part) {
  const auto shift = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& t : part.triangles) all.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

OrientedBox box_of_extent(const std::string& name, const Eigen::AlignedBox3d& extent_O, const Matrix3d& R_WO,
                          double margin) {
  OrientedBox box;
  box.name = name;
  box.center = R_WO * extent_O.center();
  box.size = extent_O.sizes() + Vector3d::Constant(2.0 * margin);
  box.R_WO = R_WO;
  return box;
}

OrientedBox enclosing_box(const std::string& name, const TriangleMesh& mesh, std::size_t first_vertex,
                          const Matrix3d& R_WO, double margin) {
  Eigen::AlignedBox3d extent;  // in O
  for (std::size_t i = first_vertex; i < mesh.vertices.size(); ++i) {
    extent.extend(Vector3d(R_WO.transpose() * mesh.vertices[i].cast<double>()));
  }
  return box_of_extent(name, extent, R_WO, margin);
}

}  // namespace skein::sim
