#include "uav_agent/maps/voxel_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;
using Cell = VoxelGrid::Cell;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A step to one of the 26 cubes around a cube.
struct Step {
  Cell cells;
  double length = 0.0;  ///< in cube edges
  /// Cubes that the step touches, without the one that it leaves, in the order in which they are checked.
  std::array<Cell, 7> parts;
  int part_count = 0;
};

const std::array<Step, 26>& all_steps() {
  static const std::array<Step, 26> steps = [] {
    std::array<Step, 26> made;
    std::size_t count = 0;
    for (int i = 0; i < kCubesAround; ++i) {
      const Cell cells = step_around(i);
      if (cells.isZero()) continue;
      Step& step = made[count++];
      step.cells = cells;
      step.length = std::sqrt(static_cast<double>(cells.squaredNorm()));
      for (int corner = 1; corner < kCubeCorners; ++corner) {
        const Cell part = corner_step(corner).cwiseProduct(cells);
        const auto end = step.parts.begin() + step.part_count;
        if (!part.isZero() && std::find(step.parts.begin(), end, part) == end) {
          step.parts[static_cast<std::size_t>(step.part_count++)] = part;
        }
      }
    }
    return made;
  }();
  return steps;
}

/// The steps that touch only passable cubes. Calls `passable` at most once for each cube.
class Steps {
 public:
  Steps(const VoxelGrid& grid, Id from, const Passable& passable)
      : grid_(grid), passable_(passable), known_(grid.count(), kUnasked) {
    known_[from] = kYes;
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      const Step& step = all_steps()[i];
      moves_[i].by = ahead(step.cells);
      moves_[i].cost = grid.voxel_m() * step.length;
      std::transform(step.parts.begin(), step.parts.begin() + step.part_count, moves_[i].parts.begin(),
                     [this](const Cell& part) { return ahead(part); });
    }
  }

  bool passable(Id id) {
    if (known_[id] == kUnasked) known_[id] = passable_(id) ? kYes : kNo;
    return known_[id] == kYes;
  }

  /// Calls `take` with each cube that one step leads to, and with the length of the step [m].
  /// @param wanted  whether a cube is of interest; if not, its step is not checked.
  template <class Wanted, class Take>
  void from(Id id, const Wanted& wanted, const Take& take) {
    const Cell c = grid_.cell(id);
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      const Step& step = all_steps()[i];
      const Cell to = c + step.cells;
      if ((to.array() < 0).any() || (to.array() >= grid_.dims().array()).any()) continue;
      const Id next = id + moves_[i].by;
      if (wanted(next) && may_step(id, moves_[i], step.part_count)) take(next, moves_[i].cost);
    }
  }

 private:
  enum Known : std::uint8_t { kUnasked, kYes, kNo };
  /// A step as differences of cube numbers, modulo 2^32: those of a step back are near 2^32.
  struct Move {
    Id by = 0;
    double cost = 0.0;
    std::array<Id, 7> parts = {};
  };
  Id ahead(const Cell& cells) const {
    const Cell& dims = grid_.dims();
    return static_cast<Id>((cells.z() * dims.y() + cells.y()) * dims.x() + cells.x());
  }

  /// Whether all cubes of the block that the step spans are passable: it touches no others.
  bool may_step(Id from, const Move& move, int parts) {
    return std::all_of(move.parts.begin(), move.parts.begin() + parts, [&](Id part) { return passable(from + part); });
  }

  const VoxelGrid& grid_;
  const Passable& passable_;
  std::array<Move, 26> moves_;
  std::vector<Known> known_;
};

/// Best-first search from one cube.
class Search {
 public:
  Search(const VoxelGrid& grid, Id from, const Passable& passable)
      : from_(from), steps_(grid, from, passable), nodes_(grid.count()) {}

  bool passable(Id id) { return steps_.passable(id); }

  void open(Id id, double cost, Id parent, const auto& to_go) {
    Node& node = nodes_[id];
    if (node.closed || node.cost <= cost) return;
    node.cost = cost;
    node.parent = parent;
    queue_.emplace(cost + to_go(id), sequence_++, id);
  }

  /// Closes and returns the open cube with the least estimated total cost; nullopt if there is none.
  std::optional<Id> next() {
    while (!queue_.empty()) {
      const Id id = std::get<2>(queue_.top());
      queue_.pop();
      if (nodes_[id].closed) continue;
      nodes_[id].closed = true;
      return id;
    }
    return std::nullopt;
  }

  void expand(Id id, const auto& to_go) {
    const double cost = nodes_[id].cost;
    steps_.from(
        id, [this](Id next) { return !nodes_[next].closed; },
        [&](Id next, double way) { open(next, cost + way, id, to_go); });
  }

  std::vector<Id> way_to(Id id) const {
    std::vector<Id> way;
    for (; id != from_; id = nodes_[id].parent) way.push_back(id);
    std::ranges::reverse(way);
    return way;
  }

 private:
  struct Node {
    double cost = kInfinity;
    Id parent = 0;
    bool closed = false;
  };
  // Ties go to the entry that was inserted first, so the order is the same on every machine.
  using Entry = std::tuple<double, std::uint64_t, Id>;

  const Id from_;
  Steps steps_;
  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  std::uint64_t sequence_ = 0;
};

}  // namespace

std::optional<std::vector<Id>> find_voxel_path(const VoxelGrid& grid, Id from, Id to, const Passable& passable,
                                               const VoxelSearchConfig& config) {
  if (from == to) return std::vector<Id>();
  Search search(grid, from, passable);
  if (!search.passable(to)) return std::nullopt;
  const Cell goal = grid.cell(to);
  // Length of the path if all cubes were passable: diagonal steps first, as long as they help on all axes.
  const auto to_go = [&](Id id) {
    Cell d = (grid.cell(id) - goal).cwiseAbs();
    std::sort(d.data(), d.data() + 3);
    const double steps = d[0] * std::numbers::sqrt3 + (d[1] - d[0]) * std::numbers::sqrt2 + (d[2] - d[1]);
    return config.heuristic_weight * grid.voxel_m() * steps;
  };
  search.open(from, 0.0, from, to_go);
  for (int expanded = 0; expanded < config.max_expansions; ++expanded) {
    const auto id = search.next();
    if (!id) return std::nullopt;
    if (*id == to) return search.way_to(to);
    search.expand(*id, to_go);
  }
  return std::nullopt;
}

std::optional<std::vector<bool>> voxels_in_reach(const VoxelGrid& grid, Id from, const Passable& passable,
                                                 std::size_t max_cubes) {
  Steps steps(grid, from, passable);
  std::vector<bool> reached(grid.count(), false);
  std::vector<Id> order = {from};
  reached[from] = true;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order.size() > max_cubes) return std::nullopt;
    steps.from(
        order[i], [&](Id next) { return !reached[next]; },
        [&](Id next, double) {
          reached[next] = true;
          order.push_back(next);
        });
  }
  return reached;
}

}  // namespace skein::agent
