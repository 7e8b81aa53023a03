// A UAV's occupancy map as two OctoMap octrees: one of hits, and a coarser one of the cells that rays passed, in which
// each ray lowers a cell's log-odds by the same amount. Space in neither tree is unknown. Each tree has an index with
// the same contents, which answers faster than a descent from the root.
// Frame W.   Units: metres.   Threads: one.   Deterministic: trees are traversed in a fixed order.
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
  /// @param cell_m  edge of an occupied cell.   @param free_cell_m  edge of a free cell: 1, 2, 4, ... times `cell_m`.
  KnownSpace(double cell_m, double free_cell_m);
  ~KnownSpace();

  /// Marks the cell of p as occupied, permanently.
  /// @returns whether the cell is newly occupied; false also for a p outside the tree, kilometres away.
  bool add_hit(const Vector3d& p_W);
  /// The same for the hits of a key frame. @returns whether any cell is newly occupied.
  bool add_hits(const HitCells& hits);
  /// The cells of these hits; does not depend on the map's contents. @param ground_m  ignores hits below this height.
  HitCells cells_of_hits(const std::vector<Eigen::Vector3f>& hits_W, double ground_m) const;
  /// The coarse cells that the rays from one place pass; does not depend on the map's contents.
  PassedCells passed_by_rays(const Vector3d& from_W, const std::vector<Vector3d>& to_W) const;
  void add_rays(const PassedCells& passed);  ///< Adds these counts to the coarse cells; a count ends at kCountedRays.

  /// Enters another map's cubes: occupied cubes as hits; in free cubes, it raises each cell's count to at least `rays`.
  /// @returns whether any cell is newly occupied.
  bool hear(const std::vector<KnownCube>& cubes, int rays);

  const HitBlocks& hits() const { return hits_; }
  const RayBlocks& rays() const { return rays_; }
  /// Number of rays that passed the coarse cell of p; at most kCountedRays.
  int rays_at(const Vector3d& p_W) const;

  /// Calls `visit` with the centre of each occupied cell in an axis-aligned box of W, given by two corners.
  void visit_hits(const Vector3d& lowest_W, const Vector3d& highest_W,
                  const std::function<void(const Vector3d&)>& visit) const;
  /// Calls `visit` with each coarse cell that rays passed, and their number. For tests, which compare the OctoMap tree
  /// with its index, rays().
  void visit_free(const std::function<void(const RayBlocks::Cell&, int)>& visit) const;

  /// Both trees merged, in OctoMap's binary serialisation: occupied where there are hits, else free where at least
  /// `rays` rays have passed, else unknown.
  std::string octomap_bytes(int rays) const;
  /// The same with OctoMap's header: the bytes of a .bt file.
  std::string octomap_file(int rays) const;

 private:
  void raise_rays(const Vector3d& p_W, int rays);

  struct Trees;
  std::unique_ptr<Trees> trees_;
  HitBlocks hits_;
  RayBlocks rays_;
};

}  // namespace skein::agent
