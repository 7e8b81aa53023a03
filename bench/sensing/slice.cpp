#include "bench/sensing/slice.hpp"

#include <array>
#include <cmath>

namespace skein::bench {

Squares squares_of(const Plane& plane, double edge_m, const Knowledge& knowledge) {
  Squares squares{.edge_m = edge_m,
                  .columns = static_cast<int>(std::lround(plane.width_m / edge_m)),
                  .rows = static_cast<int>(std::lround(plane.height_m / edge_m)),
                  .space = {}};
  for (int row = 0; row < squares.rows; ++row) {
    for (int column = 0; column < squares.columns; ++column) {
      const double right_m = (column + 0.5) * edge_m, up_m = (row + 0.5) * edge_m;
      squares.space.push_back(knowledge(plane.corner_W + right_m * plane.right_W + up_m * plane.up_W));
    }
  }
  return squares;
}

std::vector<Line> cut_of(const TriangleMesh& mesh, const Plane& plane) {
  std::vector<Line> lines;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector3d, 3> corners_W;
    std::array<double, 3> above;
    for (std::size_t i = 0; i < 3; ++i) {
      corners_W[i] = mesh.vertices[triangle[i]].cast<double>();
      above[i] = plane.above(corners_W[i]);
    }
    std::vector<Vector2d> crossings;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if ((above[i] < 0.0) == (above[j] < 0.0)) continue;
      const double part = above[i] / (above[i] - above[j]);
      crossings.push_back(plane.in_plane(corners_W[i] + part * (corners_W[j] - corners_W[i])));
    }
    if (crossings.size() == 2 && plane.holds_some(crossings[0], crossings[1]))
      lines.emplace_back(crossings[0], crossings[1]);
  }
  return lines;
}

}  // namespace skein::bench
