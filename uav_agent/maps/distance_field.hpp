// Distance field: the distance from a cell to the nearest occupied cell, computed on demand. The distances of a block
// of cells are computed at the first query for one of its cells, and again only if an occupied cell within reach has
// changed since then. A LiDAR sees 30,000 cells of the ground, and most of them are never queried.
// Units: metres; cells as in map_level.hpp.   Threads: one.   Deterministic.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/cell_rows.hpp"

namespace skein::agent {

class DistanceField {
 public:
  using Cell = Eigen::Vector3i;
  static constexpr int kBlockBits = 3, kBlock = 1 << kBlockBits;  ///< memory: cells along an edge of a block
  /// The occupied cells of a block of 8^3 cells. @param block  cell index divided by 8 (block_of()).
  using OccupiedIn = std::function<CellRows(const Cell& block)>;

  /// @param reach_m  search radius; it must be 1 to 8 times `cell_m`.
  /// @throws std::invalid_argument if it is not.
  DistanceField(double cell_m, double reach_m);

  /// Call it when a cell becomes occupied, or ceases to be occupied.
  void changed(const Cell& cell) { changed_[grid_key(block_of(cell))] = ++changes_; }

  /// Distance between the nearest points of this cell and of the nearest occupied cell, at most reach_m.
  /// @param occupied_in  reads the map; called for the blocks whose cells must be looked at again.
  double distance_m(const Cell& cell, const OccupiedIn& occupied_in);

  std::size_t bytes() const { return blocks_.bytes() + changed_.bytes() + newest_.bytes(); }

 private:
  static constexpr std::uint8_t kFar = std::numeric_limits<std::uint8_t>::max();
  struct Block {
    std::uint64_t made_at = 0;                                      ///< value of changes_ when it was computed
    std::array<std::uint8_t, kBlock* kBlock* kBlock> squares = {};  ///< [cells^2], x first; or kFar
  };

  /// Cached result of newest_change() for a block: `at`, valid as long as changes_ equals `changes`.
  struct Newest {
    std::uint64_t at = 0, changes = 0;
  };

  static Cell block_of(const Cell& cell) { return shifted(cell, kBlockBits); }
  /// Number of the last change in a block or in its 26 neighbours; 0: there was none.
  std::uint64_t newest_change(const Cell& at);
  void make(const Cell& at, const OccupiedIn& occupied_in, Block& block);

  double cell_m_, reach_m_;
  BlockTable<Block> blocks_;
  BlockTable<std::uint64_t> changed_;  ///< by block: number of its last change
  BlockTable<Newest> newest_;          ///< by block that was queried
  std::uint64_t changes_ = 0;
};

}  // namespace skein::agent
