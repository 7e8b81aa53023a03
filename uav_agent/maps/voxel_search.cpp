#include "uav_agent/maps/voxel_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;
using Cell = VoxelGrid::Cell;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Best first search from one cube.
class Search {
 public:
  Search(const VoxelGrid& grid, Id from, const Passable& passable)
      : grid_(grid), from_(from), passable_(passable), nodes_(grid.count()) {
    nodes_[from].known = kYes;
  }

  void open(Id id, double cost, Id parent, double to_go) {
    Node& node = nodes_[id];
    if (node.closed || node.cost <= cost) return;
    node.cost = cost;
    node.parent = parent;
    queue_.emplace(cost + to_go, sequence_++, id);
  }

  /// The next cube in order; nullopt when there is none.
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

  template <class ToGo>
  void expand(Id id, const ToGo& to_go) {
    const Cell c = grid_.cell(id);
    for (int i = 0; i < 27; ++i) {
      const Cell step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto next = grid_.at(Cell(c + step));
      if (!next || *next == id || nodes_[*next].closed || !may_step(c, step)) continue;
      open(*next, nodes_[id].cost + grid_.voxel_m() * std::sqrt(static_cast<double>(step.squaredNorm())), id,
           to_go(*next));
    }
  }

  bool passable(Id id) {
    Node& node = nodes_[id];
    if (node.known == kUnasked) node.known = passable_(id) ? kYes : kNo;
    return node.known == kYes;
  }
  std::vector<Id> way_to(Id id) const {
    std::vector<Id> way;
    for (; id != from_; id = nodes_[id].parent) way.push_back(id);
    std::ranges::reverse(way);
    return way;
  }

 private:
  enum Known : std::uint8_t { kUnasked, kYes, kNo };
  struct Node {
    double cost = kInfinity;
    Id parent = 0;
    Known known = kUnasked;
    bool closed = false;
  };
  // Ties go to the entry that was made first: the order is the same on every machine.
  using Entry = std::tuple<double, std::uint64_t, Id>;

  /// All cubes of the block that a step spans, so that it touches nothing else.
  bool may_step(const Cell& c, const Cell& step) {
    for (int corner = 1; corner < 8; ++corner) {
      const Cell part(corner & 1 ? step.x() : 0, corner & 2 ? step.y() : 0, corner & 4 ? step.z() : 0);
      if (!passable(*grid_.at(Cell(c + part)))) return false;
    }
    return true;
  }

  const VoxelGrid& grid_;
  const Id from_;
  const Passable& passable_;
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
  // The length of the way if nothing were in it: diagonal steps as long as they bring all axes nearer.
  const auto to_go = [&](Id id) {
    Cell d = (grid.cell(id) - goal).cwiseAbs();
    std::sort(d.data(), d.data() + 3);
    const double steps = d[0] * std::sqrt(3.0) + (d[1] - d[0]) * std::sqrt(2.0) + (d[2] - d[1]);
    return config.heuristic_weight * grid.voxel_m() * steps;
  };
  search.open(from, 0.0, from, to_go(from));
  for (int expanded = 0; expanded < config.max_expansions; ++expanded) {
    const auto id = search.next();
    if (!id) return std::nullopt;
    if (*id == to) return search.way_to(to);
    search.expand(*id, to_go);
  }
  return std::nullopt;
}

double voxel_path_length(const VoxelGrid& grid, Id from, const std::vector<Id>& path) {
  double length = 0.0;
  for (const Id id : path) {
    length += (grid.centre_W(id) - grid.centre_W(from)).norm();
    from = id;
  }
  return length;
}

}  // namespace skein::agent
