#include "grid.hpp"

#include <algorithm>
#include <cmath>

namespace baseline {
namespace {

constexpr int kHalfWidth = 80, kWidth = 2 * kHalfWidth, kHeight = 60;
constexpr int kNotSeen = -2, kStart = -1;
constexpr std::size_t kMostCells = 300000;

Cell cell_of(int index) {
  return {index % kWidth - kHalfWidth, index / kWidth % kWidth - kHalfWidth, index / (kWidth * kWidth)};
}

}  // namespace

Cell cell_at(const Vector& p_W) {
  const auto along = [&](int axis) { return static_cast<int>(std::floor(p_W[axis] / kCellM)); };
  return {along(0), along(1), along(2)};
}

Vector middle_of(const Cell& cell) { return Vector(cell.x + 0.5, cell.y + 0.5, cell.z + 0.5) * kCellM; }

std::array<Cell, 6> neighbours_of(const Cell& c) {
  return {{{c.x + 1, c.y, c.z},
           {c.x - 1, c.y, c.z},
           {c.x, c.y + 1, c.z},
           {c.x, c.y - 1, c.z},
           {c.x, c.y, c.z + 1},
           {c.x, c.y, c.z - 1}}};
}

Grid::Grid()
    : known_(kWidth * kWidth * kHeight, kUnknown),
      visited_(known_.size()),
      doubtful_(known_.size()),
      came_from_(known_.size()) {}

bool Grid::contains(const Cell& c) const {
  const auto is_inside = [](int i) { return i >= -kHalfWidth && i < kHalfWidth; };
  return is_inside(c.x) && is_inside(c.y) && c.z >= 0 && c.z < kHeight;
}

std::size_t Grid::index(const Cell& c) { return ((c.z * kWidth) + c.y + kHalfWidth) * kWidth + c.x + kHalfWidth; }

bool Grid::touches_structure(const Cell& cell) const {
  const auto neighbours = neighbours_of(cell);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const Cell& c) { return is_occupied(c); });
}

bool Grid::is_open(const Cell& cell) const {
  if (!contains(cell)) return false;
  const char known = known_[index(cell)];
  return known == kFree || (known == kUnknown && !doubtful_[index(cell)]);
}

bool Grid::learn(const Cell& cell, bool occupied) {
  if (!contains(cell)) return false;
  char& known = known_[index(cell)];
  if (known == kOccupied || (known == kFree && !occupied)) return false;
  known = occupied ? kOccupied : kFree;
  return true;
}

void Grid::doubt(const Test& test) {
  for (std::size_t i = 0; i < doubtful_.size(); ++i) doubtful_[i] = test(cell_of(static_cast<int>(i)));
}

void Grid::visit(const Cell& cell) {
  if (contains(cell)) visited_[index(cell)] = true;
}

bool Grid::find_way(const Cell& from, const Test& is_goal, const Test& barred, std::vector<Cell>& way) {
  way.clear();
  if (!contains(from)) return false;
  std::fill(came_from_.begin(), came_from_.end(), kNotSeen);
  std::vector<int> queue = {static_cast<int>(index(from))};
  came_from_[index(from)] = kStart;
  for (std::size_t i = 0; i < queue.size() && i < kMostCells; ++i) {
    const Cell cell = cell_of(queue[i]);
    if (is_goal(cell)) {
      for (int at = queue[i]; came_from_[at] != kStart; at = came_from_[at]) way.push_back(cell_of(at));
      std::reverse(way.begin(), way.end());
      return true;
    }
    for (const Cell& next : neighbours_of(cell)) {
      if (!contains(next) || came_from_[index(next)] != kNotSeen || !is_open(next) || barred(next)) continue;
      came_from_[index(next)] = queue[i];
      queue.push_back(static_cast<int>(index(next)));
    }
  }
  return false;
}

}  // namespace baseline
