// Where a fleet can get to: the part of free space that hangs together with the open sky or with a start.
// Frame: W, ground z = 0.   Units: m.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Free space is cut into level lines along x, a grid step apart. Each line is walked by clearances, which change by no
/// more than a metre a metre: so its free stretches cost few queries and are exact along x. Stretches of neighbouring
/// lines that overlap belong together. Immutable; safe from any thread.
class OpenSpace {
 public:
  /// @param world      must outlive this.
  /// @param structure  a box around all of it. Beyond that all is open sky.
  /// @param clearance  of free space [m]; not less than just over half a grid step is used, because two neighbouring
  ///                   lines could otherwise meet through a wall.
  /// @param starts     where UAVs stand; the space above them counts as open as well, also below a roof.
  /// @param threads    that walk the lines; nothing depends on their number.
  OpenSpace(const RayScene& world, const Eigen::AlignedBox3d& structure, double clearance,
            std::span<const Vector3d> starts, unsigned threads = 1);

  /// How many lines that takes: its cost. Pure.
  static std::size_t line_count(const Eigen::AlignedBox3d& structure, double clearance);

  /// Whether a place has a clear straight way to open space, to a line next to it and no farther along than a step.
  bool reaches(const Vector3d& p_W) const;

  /// Distance of neighbouring lines: the clearance, as far as that is between 0.25 and 1 m, and never so fine that a
  /// very large scene needs more than a million lines.
  double step() const { return grid_.step; }

 private:
  struct Stretch {
    double from = 0.0, until = 0.0;  ///< x
    bool open = false;
  };
  struct Place {
    std::size_t line = 0, stretch = 0;
  };
  using Line = std::vector<Stretch>;  ///< in order of x

  /// The lines over a structure: margins, step and numbers.
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
