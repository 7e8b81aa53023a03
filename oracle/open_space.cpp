#include "oracle/open_space.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/share_out.hpp"

namespace skein::sim {
namespace {

constexpr double kFinestCell = 0.25, kCoarsestCell = 1.0;
constexpr double kMostLines = 1e6;
/// Range of a query beyond the clearance [m]: a query of longer range would cost more than another step.
constexpr double kFar = 2.0;
/// Free stretches up to this height above a start are open if the start has line of sight to them [m].
constexpr double kClimb = 5.0;

std::size_t lines_over(double length, double step) { return static_cast<std::size_t>(std::ceil(length / step)) + 1; }

}  // namespace

Eigen::AlignedBox3d box_around(const TriangleMesh& structure) {
  Eigen::AlignedBox3d box(Vector3d::Zero());
  for (const auto& vertex : structure.vertices) box.extend(vertex.cast<double>());
  return box;
}

OpenSpace::Grid::Grid(const Eigen::AlignedBox3d& structure, double clearance)
    // The margin keeps the outermost lines clear of the structure, so that all space around it is connected.
    : low(structure.min() - Vector3d::Constant(clearance + 2.0 * kCoarsestCell)),
      high(structure.max() + Vector3d::Constant(clearance + 2.0 * kCoarsestCell)) {
  low.z() = 0.0;
  high.z() = std::max(high.z(), clearance + 2.0 * kCoarsestCell);
  const Vector3d size = high - low;
  step = std::max(std::clamp(clearance, kFinestCell, kCoarsestCell), std::sqrt(size.y() * size.z() / kMostLines));
  lines_y = lines_over(size.y(), step);
  lines_z = lines_over(size.z(), step);
}

std::size_t OpenSpace::line_count(const Eigen::AlignedBox3d& structure, double clearance) {
  const Grid grid(structure, clearance);
  return grid.lines_y * grid.lines_z;
}

OpenSpace::OpenSpace(const RayScene& world, const Eigen::AlignedBox3d& structure, double clearance,
                     std::span<const Vector3d> starts, unsigned threads)
    : world_(world),
      grid_(structure, clearance),
      clearance_(std::max(clearance, 0.51 * grid_.step)),
      lines_(grid_.lines_y * grid_.lines_z) {
  share_out(lines_.size(), threads, [this](std::size_t line) { lines_[line] = walk_line(line); });
  std::vector<Place> opened;
  for (std::size_t line = 0; line < lines_.size(); ++line) {
    for (std::size_t i = 0; i < lines_[line].size(); ++i) {
      Stretch& stretch = lines_[line][i];
      stretch.open = at_border(line) || stretch.from <= grid_.low.x() || stretch.until >= grid_.high.x();
      if (stretch.open) opened.push_back({line, i});
    }
  }
  for (const Vector3d& start : starts) open_above(start, opened);
  spread(std::move(opened));
}

Vector3d OpenSpace::on_line(std::size_t line, double x) const {
  const std::size_t iy = line % grid_.lines_y, iz = line / grid_.lines_y;
  return {x, grid_.low.y() + static_cast<double>(iy) * grid_.step,
          grid_.low.z() + static_cast<double>(iz) * grid_.step};
}

/// Whether a line is at a side or at the top of the grid, and so open. The bottom is not a border: lines on the ground
/// may be inside a hollow structure.
bool OpenSpace::at_border(std::size_t line) const {
  const std::size_t iy = line % grid_.lines_y, iz = line / grid_.lines_y;
  return iy == 0 || iy + 1 == grid_.lines_y || iz + 1 == grid_.lines_z;
}

OpenSpace::Line OpenSpace::walk_line(std::size_t line) const {
  const double least_step = 0.1 * grid_.step, far = clearance_ + kFar;
  Line stretches;
  bool was_free = false;
  for (double x = grid_.low.x(); x <= grid_.high.x();) {
    const double room = std::min(world_.clearance(on_line(line, x), far), far) - clearance_;
    const double next = x + std::max(std::abs(room), least_step);
    if (room >= 0.0) {
      // Certainly free up to x + room; a longer step is only taken to make progress.
      if (was_free) {
        stretches.back().until = x + room;
      } else {
        stretches.push_back({x, x + room, false});
      }
    }
    was_free = room >= 0.0;
    x = next;
  }
  return stretches;
}

void OpenSpace::open_above(const Vector3d& start, std::vector<Place>& opened) {
  const double iy = std::round((start.y() - grid_.low.y()) / grid_.step);
  if (iy < 0.0 || iy >= static_cast<double>(grid_.lines_y)) return;
  for (std::size_t iz = 0; iz < grid_.lines_z && static_cast<double>(iz) * grid_.step <= start.z() + kClimb; ++iz) {
    const std::size_t line = line_at(static_cast<std::size_t>(iy), iz);
    for (std::size_t i = 0; i < lines_[line].size(); ++i) {
      Stretch& stretch = lines_[line][i];
      const bool above = stretch.from <= start.x() && start.x() <= stretch.until;
      if (!above || stretch.open || world_.first_hit_distance(start, on_line(line, start.x()), {.ground = false})) {
        continue;
      }
      stretch.open = true;
      opened.push_back({line, i});
    }
  }
}

void OpenSpace::spread(std::vector<Place> opened) {
  while (!opened.empty()) {
    const Place place = opened.back();
    opened.pop_back();
    const Stretch from = lines_[place.line][place.stretch];
    const std::size_t iy = place.line % grid_.lines_y, iz = place.line / grid_.lines_y;
    const auto spread_to = [&](std::size_t line) {
      for (std::size_t i = 0; i < lines_[line].size(); ++i) {
        Stretch& stretch = lines_[line][i];
        if (stretch.open || stretch.until < from.from || from.until < stretch.from) continue;
        stretch.open = true;
        opened.push_back({line, i});
      }
    };
    if (iy > 0) spread_to(line_at(iy - 1, iz));
    if (iy + 1 < grid_.lines_y) spread_to(line_at(iy + 1, iz));
    if (iz > 0) spread_to(line_at(iy, iz - 1));
    if (iz + 1 < grid_.lines_z) spread_to(line_at(iy, iz + 1));
  }
}

bool OpenSpace::reaches(const Vector3d& p_W) const {
  const Vector3d cell = (p_W - grid_.low) / grid_.step;
  const double y = std::floor(cell.y()), z = std::floor(cell.z());
  const bool beyond = p_W.x() < grid_.low.x() || p_W.x() > grid_.high.x() || y < 0.0 || z < 0.0 ||
                      y + 1.0 >= static_cast<double>(grid_.lines_y) || z + 1.0 >= static_cast<double>(grid_.lines_z);
  if (beyond) return true;
  const auto iy = static_cast<std::size_t>(y), iz = static_cast<std::size_t>(z);
  for (const std::size_t line : {line_at(iy, iz), line_at(iy + 1, iz), line_at(iy, iz + 1), line_at(iy + 1, iz + 1)}) {
    for (const Stretch& stretch : lines_[line]) {
      const double x = std::clamp(p_W.x(), stretch.from, stretch.until);
      if (!stretch.open || std::abs(x - p_W.x()) > grid_.step) continue;
      // The ray is needed if the scene is huge or the clearance small; else a grid step is too short to cross a wall.
      if (!world_.first_hit_distance(p_W, on_line(line, x), {.ground = false})) return true;
    }
  }
  return false;
}

}  // namespace skein::sim
