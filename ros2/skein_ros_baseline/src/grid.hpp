// The site in cubic cells of 2.5 m along the axes of the world: which of them hold structure, and ways through the
// others. An unknown cell counts as free, unless it is doubtful, that is, near a box.
// Pure, no ROS.   Units: m.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace baseline {

using Vector = Eigen::Vector3d;

inline constexpr double kCellM = 2.5;

struct Cell {
  int x = 0, y = 0, z = 0;
  bool operator==(const Cell& other) const { return x == other.x && y == other.y && z == other.z; }
};

Cell cell_at(const Vector& p_W);
Vector middle_of(const Cell& cell);
/// The six cells that share a face with it.
std::array<Cell, 6> neighbours_of(const Cell& cell);

class Grid {
 public:
  using Test = std::function<bool(const Cell&)>;

  Grid();

  /// The grid reaches 200 m to each side, and from the ground to 150 m.
  bool contains(const Cell& cell) const;
  bool is_occupied(const Cell& cell) const { return contains(cell) && known_[index(cell)] == kOccupied; }
  /// Whether a vehicle may enter it.
  bool is_open(const Cell& cell) const;
  bool touches_structure(const Cell& cell) const;
  bool is_visited(const Cell& cell) const { return contains(cell) && visited_[index(cell)]; }

  /// An occupied cell stays occupied. @returns whether the grid has changed
  bool learn(const Cell& cell, bool occupied);
  void visit(const Cell& cell);
  /// From now on the cells for which `test` holds are doubtful.
  void doubt(const Test& test);

  /// The shortest way through common faces to the nearest goal, without `from` itself; empty if `from` is a goal. It
  /// enters only cells that are open and not `barred`.
  /// @returns false if a search of 300,000 cells finds none
  bool find_way(const Cell& from, const Test& is_goal, const Test& barred, std::vector<Cell>& way);

 private:
  static std::size_t index(const Cell& cell);

  static constexpr char kUnknown = 0, kFree = 1, kOccupied = 2;
  std::vector<char> known_, visited_, doubtful_;
  std::vector<int> came_from_;  ///< of a search, by index: the cell before
};

}  // namespace baseline
