// Solid shapes for procedural scenes, appended to one triangle mesh.
// Every shape is a closed surface with outward winding (counter-clockwise as seen from outside), so "inside" stays well
// defined even if shapes overlap.   Frames: W; L local to a shape.   Units: m.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scenario/scene.hpp"

namespace skein::sim {

using Ring = std::vector<Vector3d>;
using Polygon = std::vector<Vector2d>;

inline constexpr double kSunk = -0.2;  ///< solids begin a little below the ground, so that there is no gap under them
inline constexpr double kBoxMargin = 0.5;  ///< margin of the boxes around a scene's structures [m]

/// Regular polygon about the origin, counter-clockwise; the first corner at `phase` [rad]. Pure.
Polygon regular_polygon(int corners, double radius, double phase = 0.0);
/// Axis-aligned rectangle about `center`, its corners cut off by `chamfer`; counter-clockwise. Pure.
Polygon rectangle(const Vector2d& center, const Vector2d& size, double chamfer = 0.0);

/// The frame of a structure that stands on the ground: origin at z = 0, turned about z. Pure.
Isometry3d standing_at(const Vector2d& p_W, double heading);

/// Collects shapes. Stores vertices in single precision, as in every mesh.
class MeshBuilder {
 public:
  /// A solid whose skin connects consecutive rings. All rings have the same number of corners, and are
  /// counter-clockwise as seen against the direction of their sequence (from above, if the rings go up). A fan closes
  /// each end, around the ring's centre or the given apex; the end must be star-shaped as seen from there.
  /// @throws std::invalid_argument for fewer than two rings, fewer than three corners, or unequal rings.
  void add_loft(std::span<const Ring> rings, const std::optional<Vector3d>& first_apex = std::nullopt,
                const std::optional<Vector3d>& last_apex = std::nullopt);

  /// A curved sheet between two grids of points, closed along its rim. A grid is a list of rows with the same number of
  /// points. The cross product (direction of a row) x (direction from row to row) points out of the front. Each point
  /// of the back lies behind the point of the front with the same indices.
  /// @throws std::invalid_argument for fewer than two rows or columns, or unequal ones.
  void add_sheet(std::span<const Ring> front, std::span<const Ring> back);

  /// A polygon in the local xy plane, extruded from z0 up to z1.
  void add_prism(const Isometry3d& X_WL, const Polygon& polygon, double z0, double z1);

  /// A box centred on the origin of L.
  void add_box(const Isometry3d& X_WL, const Vector3d& size);

  /// A round bar with flat ends.
  void add_cylinder(const Vector3d& from, const Vector3d& to, double radius, int sides = 12);

  /// A thin bar of square section.
  void add_member(const Vector3d& from, const Vector3d& to, double thickness);

  /// The part of an ellipsoid above the local height z0, where it is cut flat. Its centre is the origin of L, its axes
  /// those of L.
  void add_dome(const Isometry3d& X_WL, const Vector3d& half_axes, double z0, int sides = 24, int levels = 8);

  const TriangleMesh& mesh() const { return mesh_; }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t add_vertex(const Vector3d& p);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

  TriangleMesh mesh_;
};

/// Appends a mesh to another one, with its vertex indices shifted.
void append(TriangleMesh& all, const TriangleMesh& part);

/// The box with the given axes around an extent along them.  @param margin  added on all sides [m].
OrientedBox box_of_extent(const std::string& name, const Eigen::AlignedBox3d& extent_O, const Matrix3d& R_WO,
                          double margin);
/// Smallest box with the given axes around the vertices of a mesh from `first_vertex` on. Pure.
/// @param margin  added on all sides [m].
OrientedBox enclosing_box(const std::string& name, const TriangleMesh& mesh, std::size_t first_vertex,
                          const Matrix3d& R_WO, double margin);

}  // namespace skein::sim
