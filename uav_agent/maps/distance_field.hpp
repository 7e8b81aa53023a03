// How far it is to the nearest cell that is occupied. Kept up to date where it is asked for: a block of cells is worked
// out when one of its cells is asked for, and again only if something within reach has changed since. A LiDAR sees
// 30,000 cells of the ground, and nobody asks about most of them.
// Units: metres; cells as in map_level.hpp.   Threads: one.   Deterministic.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {

class DistanceField {
 public:
  using Cell = Eigen::Vector3i;
  static constexpr int kBlockBits = 3, kBlock = 1 << kBlockBits;  ///< cells along an edge of a block
  /// Appends the cells of a block of 8^3, given by its number, that are occupied.
  using OccupiedIn = std::function<void(const Cell& block, std::vector<Cell>& cells)>;

  /// @param reach_m  farther cells are not looked for: 1 to 8 cells.
  /// @throws std::invalid_argument for another reach.
  DistanceField(double cell_m, double reach_m);

  /// The cell has become occupied, or is occupied no more.
  void changed(const Cell& cell) { changed_[grid_key(block_of(cell))] = ++changes_; }

  /// Between the nearest points of the cell and of the nearest occupied one; reach_m if that is not nearer.
  double distance_m(const Cell& cell, const OccupiedIn& occupied_in);

  std::size_t bytes() const { return blocks_.bytes() + changed_.bytes() + newest_.bytes(); }

 private:
  static constexpr std::uint8_t kFar = 255;
  struct Block {
    std::uint64_t made_at = 0;                                      ///< in changes
    std::array<std::uint8_t, kBlock* kBlock* kBlock> squares = {};  ///< of distances in cells, x first
  };

  /// The last change within reach of a block, as it was when there had been so many in all.
  struct Newest {
    std::uint64_t at = 0, changes = 0;
  };

  static Cell block_of(const Cell& cell) { return shifted(cell, kBlockBits); }
  /// Of a block and those about it; 0: none.
  std::uint64_t newest_change(const Cell& at);
  void make(const Cell& at, const OccupiedIn& occupied_in, Block& block);

  double cell_m_, reach_m_;
  BlockTable<Block> blocks_;
  BlockTable<std::uint64_t> changed_;  ///< by block: number of its last change
  BlockTable<Newest> newest_;          ///< of blocks that were asked for
  std::uint64_t changes_ = 0;
  std::vector<Cell> occupied_;
};

}  // namespace skein::agent
