// Solid shapes for procedural scenes, appended to one triangle mesh.
// Every shape is a closed surface with outward winding (counter-clockwise as seen from outside), so that shapes may
// overlap and "inside" stays well defined.   Frame: W.   Units: m.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

using Ring = std::vector<Vector3d>;
using Polygon = std::vector<Vector2d>;

inline constexpr double kSunk = -0.2;      ///< solids begin a little below the ground, so that none has a gap under it
inline constexpr double kBoxMargin = 0.5;  ///< of the boxes around a scene's structures [m]

/// Regular polygon about the origin, counter-clockwise; the first corner at `phase` [rad]. Pure.
Polygon regular_polygon(int corners, double radius, double phase = 0.0);
/// Axis-aligned rectangle about `center`, its corners cut off by `chamfer`; counter-clockwise. Pure.
Polygon rectangle(const Vector2d& center, const Vector2d& size, double chamfer = 0.0);

/// The frame of a structure that stands on the ground: origin at z = 0, turned about z. Pure.
Isometry3d standing_at(const Vector2d& p_W, double heading);

/// Collects shapes. Vertices are kept in single precision, as every mesh has them.
class MeshBuilder {
 public:
  /// A solid skinned over rings of equally many corners, all counter-clockwise as seen against the direction in
  /// which the rings follow each other (from above, for rings that go up). The ends are closed by a fan about the
  /// ring's centre, or about an apex where one is given; an end must be star-shaped as seen from there.
  /// @throws std::invalid_argument for fewer than two rings, fewer than three corners, or unequal rings.
  void add_loft(std::span<const Ring> rings, const std::optional<Vector3d>& first_apex = std::nullopt,
                const std::optional<Vector3d>& last_apex = std::nullopt);

  /// A curved sheet between two grids of points, closed along its rim. A grid is a list of rows of equally many points;
  /// (along a row) x (from row to row) points out of the front. The back lies behind the front, point by point.
  /// @throws std::invalid_argument for fewer than two rows or columns, or unequal ones.
  void add_sheet(std::span<const Ring> front, std::span<const Ring> back);

  /// A polygon of the local xy plane, extruded from z0 up to z1.
  void add_prism(const Isometry3d& X_WL, const Polygon& polygon, double z0, double z1);

  /// A box centred on the origin of L.
  void add_box(const Isometry3d& X_WL, const Vector3d& size);

  /// A round bar with flat ends.
  void add_cylinder(const Vector3d& from, const Vector3d& to, double radius, int sides = 12);

  /// A thin bar of square section.
  void add_member(const Vector3d& from, const Vector3d& to, double thickness);

  /// An ellipsoid with half axes along L, from the local height z0 (cut flat there) up to its top.
  void add_dome(const Isometry3d& X_WL, const Vector3d& half_axes, double z0, int sides = 24, int levels = 8);

  const TriangleMesh& mesh() const { return mesh_; }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t add_vertex(const Vector3d& p);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

  TriangleMesh mesh_;
};

/// Puts a mesh behind another one, its indices shifted.
void append(TriangleMesh& all, const TriangleMesh& part);

/// Smallest box with the given axes around some of a mesh's vertices.
/// @param first_vertex  vertices from this one on.   @param margin  added on all sides [m].
OrientedBox enclosing_box(const std::string& name, const TriangleMesh& mesh, std::size_t first_vertex,
                          const Matrix3d& R_WO, double margin);

}  // namespace skein::sim
