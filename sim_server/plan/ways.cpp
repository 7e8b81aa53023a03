#include "sim_server/plan/ways.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "sight/clear_line.hpp"
#include "sim_server/plan/team.hpp"

namespace skein::sim {
namespace {

constexpr double kFinestLattice = 2.0, kCoarserLattice = 1.15;  ///< spacing of the lattice [m]; factor between spacings
constexpr double kNearStructure = 2.5;  ///< in spacings: nodes farther from the structure are not needed
constexpr std::size_t kMostAnchors = 4, kMostAsked = 24;
constexpr float kHop = 2.0F;  ///< cost of a corner, because the UAV stops there [m]
constexpr float kNoWay = std::numeric_limits<float>::infinity();

}  // namespace

Ways::Ways(const RayScene& world, const Eigen::AlignedBox3d& space, double clearance, std::size_t most_nodes)
    : world_(world), clearance_(clearance) {
  std::vector<Eigen::Vector3i> cells;
  for (spacing_ = kFinestLattice;; spacing_ *= kCoarserLattice) {
    const Eigen::Vector3i count = (space.sizes() / spacing_).array().ceil().cast<int>() + 1;
    // Too many nodes to check all of them.
    if (static_cast<double>(count.x()) * count.y() * count.z() > 40.0 * static_cast<double>(most_nodes)) continue;
    nodes_.clear();
    cells.clear();
    for (int x = 0; x < count.x(); ++x) {
      for (int y = 0; y < count.y(); ++y) {
        for (int z = 0; z < count.z(); ++z) {
          const Vector3d p_W = space.min() + spacing_ * Vector3d(x, y, z);
          const double room = world.clearance(p_W, clearance + kNearStructure * spacing_);
          if (room < clearance || room > clearance + kNearStructure * spacing_) continue;
          nodes_.push_back(p_W);
          cells.emplace_back(x, y, z);
        }
      }
    }
    if (nodes_.size() <= most_nodes) break;
  }
  join(cells);
}

void Ways::join(const std::vector<Eigen::Vector3i>& cells) {
  const auto before = [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  edges_.resize(nodes_.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (int n = 14; n < 27; ++n) {  // half of the 26 neighbours: each pair once
      const Eigen::Vector3i other = cells[i] + Eigen::Vector3i(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
      const auto found = std::lower_bound(cells.begin(), cells.end(), other, before);
      if (found == cells.end() || *found != other) continue;
      const auto j = static_cast<std::size_t>(found - cells.begin());
      if (!clear(nodes_[i], nodes_[j])) continue;
      const auto length = static_cast<float>((nodes_[i] - nodes_[j]).norm()) + kHop;
      edges_[i].push_back({j, length});
      edges_[j].push_back({i, length});
    }
  }
}

bool Ways::clear(const Vector3d& a_W, const Vector3d& b_W) const {
  return is_clear_line(world_, a_W, b_W, clearance_, 0.5 * kSlack);
}

std::vector<std::size_t> Ways::anchors(const Vector3d& p_W) const {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < nodes_.size(); ++i) near.emplace_back((nodes_[i] - p_W).squaredNorm(), i);
  const auto asked = static_cast<std::ptrdiff_t>(std::min(kMostAsked, near.size()));
  std::partial_sort(near.begin(), near.begin() + asked, near.end());
  near.resize(static_cast<std::size_t>(asked));
  std::vector<std::size_t> anchors;
  for (const auto& [distance2, node] : near) {
    if (anchors.size() == kMostAnchors) break;
    if (clear(p_W, nodes_[node])) anchors.push_back(node);
  }
  return anchors;
}

const Ways::Tree& Ways::tree(std::size_t root) {
  const auto [known, fresh] = trees_.try_emplace(root);
  if (!fresh) return known->second;
  Tree& tree = known->second;
  tree.length.assign(nodes_.size(), kNoWay);
  tree.before.assign(nodes_.size(), root);
  tree.length[root] = 0.0F;
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.emplace(0.0F, root);
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > tree.length[node]) continue;
    for (const Edge& edge : edges_[node]) {
      if (length + edge.length >= tree.length[edge.to]) continue;
      tree.length[edge.to] = length + edge.length;
      tree.before[edge.to] = node;
      open.emplace(length + edge.length, edge.to);
    }
  }
  return tree;
}

std::vector<Vector3d> Ways::shortened(const Vector3d& a_W, const std::vector<Vector3d>& corners) const {
  std::vector<Vector3d> kept;
  Vector3d at = a_W;
  for (std::size_t next = 0; next < corners.size();) {
    std::size_t farthest = next;
    for (std::size_t i = corners.size(); i-- > next + 1;) {
      if (!clear(at, corners[i])) continue;
      farthest = i;
      break;
    }
    kept.push_back(at = corners[farthest]);
    next = farthest + 1;
  }
  return kept;
}

std::vector<Vector3d> Ways::way(const Vector3d& a_W, std::span<const std::size_t> from, const Vector3d& b_W,
                                std::span<const std::size_t> to) {
  if (clear(a_W, b_W)) return {b_W};
  float least = kNoWay;
  std::pair<std::size_t, std::size_t> best;
  for (const std::size_t i : from) {
    const Tree& tree_i = tree(i);
    for (const std::size_t j : to) {
      const float length = tree_i.length[j] + static_cast<float>((nodes_[i] - a_W).norm() + (nodes_[j] - b_W).norm());
      if (length >= least) continue;
      least = length;
      best = {i, j};
    }
  }
  if (least == kNoWay) return {};
  std::vector<Vector3d> corners = {b_W};
  const Tree& tree_i = tree(best.first);
  for (std::size_t node = best.second; node != best.first; node = tree_i.before[node]) corners.push_back(nodes_[node]);
  corners.push_back(nodes_[best.first]);
  std::ranges::reverse(corners);
  return shortened(a_W, corners);
}

}  // namespace skein::sim
