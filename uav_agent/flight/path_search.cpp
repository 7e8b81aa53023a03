#include "uav_agent/flight/path_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

using Cell = Eigen::Vector3i;

/// The search may begin in a cell up to this many cells from the start, along each axis. Chosen.
constexpr int kEscapeCells = 3;
/// From a cell that is nearer to the goal than this, in cells, the search tries to go straight to it. Geometry:
/// a little more than the diagonal of a cell.
constexpr double kLastCells = 1.8;

class Search {
 public:
  Search(const FreeSpace& space, const std::vector<OrientedBox>& structure, const Vector3d& from, const Vector3d& to,
         const PathSearchConfig& config)
      : space_(space), from_(from), to_(to), config_(config), lo_(from.cwiseMin(to)), hi_(from.cwiseMax(to)) {
    for (const OrientedBox& box : structure) {
      const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
      lo_ = lo_.cwiseMin(box.center - half);
      hi_ = hi_.cwiseMax(box.center + half);
    }
    lo_.array() -= config.margin_m;
    hi_.array() += config.margin_m;
  }

  std::optional<std::vector<Vector3d>> run() {
    if (!space_.free(to_)) return std::nullopt;
    const auto last = search([this](const Cell& cell) {
      return (centre(cell) - to_).norm() < kLastCells * config_.cell_m && space_.segment_free(centre(cell), to_);
    });
    if (!last) return std::nullopt;
    std::vector<Vector3d> corners = trace_back(*last);
    corners.push_back(to_);
    return shortened(corners);
  }
  bool gave_up() const { return gave_up_; }

  /// Path to the reachable cell nearest to the goal, if it is more than worth_m nearer to the goal than the start is.
  std::optional<std::vector<Vector3d>> run_near(double worth_m) {
    std::optional<Cell> nearest;
    double distance = (from_ - to_).norm() - worth_m;
    search([&](const Cell& cell) {
      if ((centre(cell) - to_).norm() < distance) {
        distance = (centre(cell) - to_).norm();
        nearest = cell;
      }
      return false;
    });
    if (!nearest) return std::nullopt;
    return shortened(trace_back(*nearest));
  }

 private:
  struct Node {
    double cost = 0.0;
    Cell parent;
    bool closed = false;
  };
  // Entries of equal cost are expanded in the order of insertion, which is the same on every machine.
  using Entry = std::tuple<double, std::uint64_t, Cell>;
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      return std::tie(std::get<0>(a), std::get<1>(a)) > std::tie(std::get<0>(b), std::get<1>(b));
    }
  };

  /// Expands cells in the order of A*. @returns the first one for which `last` is true; nullopt if none was found.
  std::optional<Cell> search(const auto& last) {
    const auto start = start_cell();
    if (!start) return std::nullopt;
    open(*start, 0.0, *start);
    for (int expanded = 0; expanded < config_.max_expansions && !queue_.empty(); ++expanded) {
      const Cell cell = std::get<2>(queue_.top());
      queue_.pop();
      Node& node = nodes_.at(grid_key(cell));
      if (node.closed) continue;
      node.closed = true;
      if (last(cell)) return cell;
      expand(cell, node.cost);
    }
    gave_up_ = !queue_.empty();
    return std::nullopt;
  }

  Vector3d centre(const Cell& c) const { return (c.cast<double>() + Vector3d::Constant(0.5)) * config_.cell_m; }

  bool passable(const Vector3d& p) const {
    return (p.array() >= lo_.array()).all() && (p.array() <= hi_.array()).all() && space_.free(p);
  }

  /// Cell at which the search begins: the nearest free one to which a straight segment leads from the start. The
  /// segment must be free, or a way out (FreeSpace::leads_out()) if the start is not free.
  std::optional<Cell> start_cell() const {
    const Cell own = (from_ / config_.cell_m).array().floor().matrix().cast<int>();
    const bool start_is_free = space_.free(from_);
    std::optional<Cell> best;
    double best_distance = 0.0;
    for (int z = -kEscapeCells; z <= kEscapeCells; ++z) {
      for (int y = -kEscapeCells; y <= kEscapeCells; ++y) {
        for (int x = -kEscapeCells; x <= kEscapeCells; ++x) {
          const Cell c = own + Cell(x, y, z);
          const double distance = (centre(c) - from_).norm();
          if (best && distance >= best_distance) continue;
          if (!passable(centre(c))) continue;
          if (start_is_free && !space_.segment_free(from_, centre(c))) continue;
          if (!start_is_free && !space_.leads_out(from_, centre(c))) continue;
          best = c;
          best_distance = distance;
        }
      }
    }
    return best;
  }

  void open(const Cell& cell, double cost, const Cell& parent) {
    const auto [it, is_new] = nodes_.try_emplace(grid_key(cell), Node{cost, parent});
    if (!is_new) {
      if (it->second.closed || it->second.cost <= cost) return;
      it->second.cost = cost;
      it->second.parent = parent;
    }
    queue_.emplace(cost + config_.heuristic * (to_ - centre(cell)).norm(), sequence_++, cell);
  }

  void expand(const Cell& cell, double cost) {
    for (int i = 0; i < kCubesAround; ++i) {
      const Cell step = step_around(i);
      if (step.isZero()) continue;
      const Cell next = cell + step;
      const auto known = nodes_.find(grid_key(next));
      if (known != nodes_.end() && known->second.closed) continue;
      if (!free_cell(next) || !passable(0.5 * (centre(cell) + centre(next)))) continue;
      const double way_m = config_.cell_m * std::sqrt(static_cast<double>(step.squaredNorm()));
      open(next, cost + way_m * space_.cost(centre(next)), cell);
    }
  }

  bool free_cell(const Cell& c) {
    const auto [it, is_new] = passable_.try_emplace(grid_key(c), false);
    if (is_new) it->second = passable(centre(c));
    return it->second;
  }

  std::vector<Vector3d> trace_back(Cell cell) const {
    std::vector<Vector3d> corners;
    while (true) {
      corners.push_back(centre(cell));
      const Cell parent = nodes_.at(grid_key(cell)).parent;
      if (parent == cell) break;
      cell = parent;
    }
    std::reverse(corners.begin(), corners.end());
    return corners;
  }

  std::vector<Vector3d> shortened(const std::vector<Vector3d>& corners) const {
    std::vector<Vector3d> out;
    Vector3d at = from_;
    std::size_t next = 0;
    if (!space_.free(from_)) {  // no segment from here is free, so there is no short cut
      at = corners[0];
      out.push_back(at);
      next = 1;
    }
    while (next < corners.size()) {
      std::size_t far = corners.size() - 1;
      while (far > next && !space_.segment_free(at, corners[far])) far = next + (far - next) / 2;
      at = corners[far];
      out.push_back(at);
      next = far + 1;
    }
    return out;
  }

  const FreeSpace& space_;
  const Vector3d from_, to_;
  const PathSearchConfig config_;
  Vector3d lo_, hi_;
  std::unordered_map<std::uint64_t, Node> nodes_;  // only looked up, never iterated: its order is unspecified
  std::unordered_map<std::uint64_t, bool> passable_;
  std::priority_queue<Entry, std::vector<Entry>, Later> queue_;
  std::uint64_t sequence_ = 0;
  bool gave_up_ = false;
};

}  // namespace

std::optional<std::vector<Vector3d>> find_path(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                               const Vector3d& from_W, const Vector3d& to_W,
                                               const PathSearchConfig& config, bool* gave_up) {
  if (gave_up) *gave_up = false;
  if (space.segment_free(from_W, to_W)) return std::vector<Vector3d>{to_W};
  Search search(space, structure, from_W, to_W, config);
  auto path = search.run();
  if (gave_up) *gave_up = search.gave_up();
  return path;
}

std::optional<std::vector<Vector3d>> find_approach(const FreeSpace& space, const std::vector<OrientedBox>& structure,
                                                   const Vector3d& from_W, const Vector3d& to_W, double worth_m,
                                                   const PathSearchConfig& config) {
  return Search(space, structure, from_W, to_W, config).run_near(worth_m);
}

Path path_through(const std::vector<Vector3d>& places_W, double speed_mps) {
  Path path;
  for (const Vector3d& p_W : places_W) path.waypoints.push_back({p_W, speed_mps});
  return path;
}

double path_length(const Vector3d& from_W, const std::vector<Vector3d>& corners_W) {
  double length = 0.0;
  Vector3d at = from_W;
  for (const Vector3d& corner : corners_W) {
    length += (corner - at).norm();
    at = corner;
  }
  return length;
}

}  // namespace skein::agent
