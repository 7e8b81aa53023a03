// Plane slices through a map's knowledge and through the structure.
// Frames: W world; plane coordinates (right, up), with the origin in the plane's lower left corner.
// Units: metres.   Pure; any thread.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/scenario/scene.hpp"
#include "uav_agent/maps/map_level.hpp"

namespace skein::bench {

/// Whether a map considers a point free, occupied or unknown.
using Knowledge = std::function<agent::Space(const Vector3d& p_W)>;

struct Plane {
  Vector3d corner_W = Vector3d::Zero();
  Vector3d right_W = Vector3d::UnitX(), up_W = Vector3d::UnitY();  ///< unit vectors, perpendicular to each other
  double width_m = 1.0, height_m = 1.0;

  Vector2d in_plane(const Vector3d& p_W) const { return {(p_W - corner_W).dot(right_W), (p_W - corner_W).dot(up_W)}; }
  /// Signed distance of a point from the plane.
  double above(const Vector3d& p_W) const { return (p_W - corner_W).dot(right_W.cross(up_W)); }
  /// Whether a line, in plane coordinates, may pass through the plane's rectangle.
  bool holds_some(const Vector2d& a, const Vector2d& b) const {
    const Vector2d low = a.cwiseMin(b), high = a.cwiseMax(b);
    return high.minCoeff() >= 0.0 && low.x() <= width_m && low.y() <= height_m;
  }
};

/// A plane's squares, row by row from the lowest.
struct Squares {
  double edge_m = 0.5;
  int columns = 0, rows = 0;
  std::vector<agent::Space> space;

  agent::Space at(int column, int row) const { return space[static_cast<std::size_t>(row * columns + column)]; }
};

/// Evaluates `knowledge` at the centre of each square.
Squares squares_of(const Plane& plane, double edge_m, const Knowledge& knowledge);

using Line = std::pair<Vector2d, Vector2d>;
/// Intersections of triangles with a plane, in plane coordinates; only those that may pass through its rectangle.
std::vector<Line> cut_of(const TriangleMesh& mesh, const Plane& plane);

}  // namespace skein::bench
