// Paths of one kind of UAV through the true scene: straight lines that keep its clearance, with detours around the
// structure.
// Frame: W, ground z = 0.   Units: m.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// A graph of free places on a lattice around the structure. Edges are straight lines that keep the clearance. Not
/// thread-safe.
class Ways {
 public:
  /// Lines may come this much nearer to the structure than the clearance [m].
  static constexpr double kSlack = 0.05;

  /// @param world  without UAVs; must outlive this.   @param space  bounds of the lattice.
  Ways(const RayScene& world, const Eigen::AlignedBox3d& space, double clearance, std::size_t most_nodes);

  /// Whether a straight line keeps the clearance, except for kSlack.
  bool clear(const Vector3d& a_W, const Vector3d& b_W) const;

  /// Some of the nearest nodes that can be reached from a place on a straight line.
  std::vector<std::size_t> anchors(const Vector3d& p_W) const;

  /// Corners of a path from a to b, without a and with b. Empty if there is no path.
  /// @param from, to  anchors() of the two.
  std::vector<Vector3d> way(const Vector3d& a_W, std::span<const std::size_t> from, const Vector3d& b_W,
                            std::span<const std::size_t> to);

  /// The nodes; and the lengths of the shortest paths from one node to all others, infinite if there is no path.
  const std::vector<Vector3d>& nodes() const { return nodes_; }
  const std::vector<float>& lengths_from(std::size_t node) { return tree(node).length; }

 private:
  struct Edge {
    std::size_t to;
    float length;
  };
  struct Tree {
    std::vector<float> length;
    std::vector<std::size_t> before;
  };
  void join(const std::vector<Eigen::Vector3i>& cells);
  const Tree& tree(std::size_t root);
  std::vector<Vector3d> shortened(const Vector3d& a_W, const std::vector<Vector3d>& corners) const;

  const RayScene& world_;
  double clearance_;
  double spacing_ = 0.0;
  std::vector<Vector3d> nodes_;
  std::vector<std::vector<Edge>> edges_;
  std::map<std::size_t, Tree> trees_;  ///< by root, computed on demand
};

}  // namespace skein::sim
