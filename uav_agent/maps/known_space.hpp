// What a UAV knows of the space around it, as OctoMap keeps it: an octree of hits and a coarser one of what rays have
// passed, in which each ray lowers a cell's log-odds by as much. What neither holds is unknown. Beside each tree stands
// an index of it, which answers faster than a walk from the root; both always say the same.
// Frame W.   Units: metres.   Threads: one.   Deterministic: trees are walked through in a fixed order.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/files/octree_bytes.hpp"
#include "uav_agent/maps/hit_blocks.hpp"
#include "uav_agent/maps/ray_blocks.hpp"

namespace skein::agent {

class KnownSpace {
 public:
  /// @param cell_m  edge of an occupied cell.   @param free_cell_m  edge of a free one: 1, 2, 4, ... times as long.
  KnownSpace(double cell_m, double free_cell_m);
  ~KnownSpace();

  /// Makes the cell of p occupied, for good.
  /// @returns whether that is news; false, too, beyond the tree: kilometres away.
  bool add_hit(const Vector3d& p_W);
  /// The same for the hits of a key frame. @returns whether any is news.
  bool add_hits(const HitCells& hits);
  /// Asks for nothing that is known. @param ground_m  hits below are none.
  HitCells cells_of_hits(const std::vector<Eigen::Vector3f>& hits_W, double ground_m) const;
  /// Which coarse cells the rays from one place pass; asks for nothing that is known.
  PassedCells passed_by_rays(const Vector3d& from_W, const std::vector<Vector3d>& to_W) const;
  void add_rays(const PassedCells& passed);

  /// Occupied cubes are hits; in free ones so many rays passed, if not more. @returns whether any hit is news.
  bool hear(const std::vector<KnownCube>& cubes, int rays);

  const HitBlocks& hits() const { return hits_; }
  const RayBlocks& rays() const { return rays_; }
  /// That passed the coarse cell of p; at most kCountedRays.
  int rays_at(const Vector3d& p_W) const;

  /// The tree's occupied cells in the box along W's axes, by their centres.
  void visit_hits(const Vector3d& lowest_W, const Vector3d& highest_W,
                  const std::function<void(const Vector3d&)>& visit) const;
  /// The tree's free cells, with the rays that passed them.
  void visit_free(const std::function<void(const RayBlocks::Cell&, int)>& visit) const;

  /// Both trees in one, in OctoMap's binary serialisation: occupied where there are hits, else free where so many rays
  /// have passed, else nothing.
  std::string octomap_bytes(int rays) const;
  /// The same with its head: a file of the kind .bt.
  std::string octomap_file(int rays) const;

 private:
  void raise_rays(const Vector3d& p_W, int rays);

  struct Trees;
  std::unique_ptr<Trees> trees_;
  HitBlocks hits_;
  RayBlocks rays_;
};

}  // namespace skein::agent
