// The space that a fleet can reach ("open space"): the part of free space that is connected to the unbounded space
// around the structure, or to a start.   Frame: W, ground z = 0.   Units: m.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// The box around a structure and the origin of W.
Eigen::AlignedBox3d box_around(const TriangleMesh& structure);

/// Represents free space by horizontal lines along x, one grid step apart. The clearance changes by at most a metre per
/// metre, so stepping along a line from clearance to clearance finds its free stretches with few queries, and exactly
/// along x. Overlapping stretches of neighbouring lines are connected. Immutable; safe from any thread.
class OpenSpace {
 public:
  /// @param world      must outlive this.
  /// @param structure  a box around the whole structure. All space beyond it is open.
  /// @param clearance  of free space from the structure [m]. The class uses at least 0.51 grid steps, because otherwise
  ///                   two neighbouring lines could be connected through a wall.
  /// @param starts     where UAVs stand; the space above them is open, too, even under a roof.
  /// @param threads    number of threads that process the lines; the result does not depend on it.
  OpenSpace(const RayScene& world, const Eigen::AlignedBox3d& structure, double clearance,
            std::span<const Vector3d> starts, unsigned threads = 1);

  /// Number of lines that the constructor would process: a measure of its cost. Pure.
  static std::size_t line_count(const Eigen::AlignedBox3d& structure, double clearance);

  /// Whether a place is connected to open space: a clear straight line leads to an open stretch of one of the four
  /// lines around it, at most a grid step away along x. True beyond the grid.
  bool reaches(const Vector3d& p_W) const;

  /// Distance between neighbouring lines: the clearance, limited to 0.25 to 1 m; larger if a very large scene would
  /// otherwise need more than about a million lines.
  double step() const { return grid_.step; }

 private:
  struct Stretch {
    double from = 0.0, until = 0.0;  ///< range of x
    bool open = false;
  };
  struct Place {
    std::size_t line = 0, stretch = 0;
  };
  using Line = std::vector<Stretch>;  ///< ascending in x

  /// The grid of lines over a structure with its margins.
  struct Grid {
    Vector3d low, high;
    double step;
    std::size_t lines_y, lines_z;
    Grid(const Eigen::AlignedBox3d& structure, double clearance);
  };

  Line walk_line(std::size_t line) const;
  std::size_t line_at(std::size_t iy, std::size_t iz) const { return iz * grid_.lines_y + iy; }
  Vector3d on_line(std::size_t line, double x) const;
  bool at_border(std::size_t line) const;
  void open_above(const Vector3d& start, std::vector<Place>& opened);
  void spread(std::vector<Place> opened);

  const RayScene& world_;
  Grid grid_;
  double clearance_;
  std::vector<Line> lines_;
};

}  // namespace skein::sim
