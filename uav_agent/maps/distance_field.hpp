// How far it is to the nearest cell that is occupied, for each cell about one: kept up to date as cells become
// occupied. A new one is told to all cells within reach, so distances are exact and do not depend on an order.
// Units: metres; cells as in map_level.hpp.   Threads: one.   Deterministic.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {

class DistanceField {
 public:
  using Cell = Eigen::Vector3i;

  /// @param reach_m  farther cells are told nothing: less than 16 cells.
  DistanceField(double cell_m, double reach_m);

  /// The cell is occupied now.
  void add(const Cell& cell);
  /// These are occupied no more.
  /// @param occupied_in  all cells of a block of 8^3, given by its number, that are occupied, without these.
  using OccupiedIn = std::function<std::vector<Cell>(const Cell& block)>;
  void remove(std::span<const Cell> cells, const OccupiedIn& occupied_in);

  /// Between the nearest points of the cell and of the nearest occupied one; reach_m() if that is not nearer.
  double distance_m(const Cell& cell) const;
  double reach_m() const { return reach_m_; }
  std::size_t bytes() const { return blocks_.bytes(); }

 private:
  static constexpr int kBlockBits = 3, kBlock = 1 << kBlockBits;
  static constexpr std::uint8_t kFar = 255;
  /// Squared distances in cells, x first.
  struct Block {
    std::array<std::uint8_t, kBlock * kBlock * kBlock> squares;
    Block() { squares.fill(kFar); }
  };
  /// Calls for each block with a cell within `cells` of one, along each axis.
  template <class Visit>
  static void blocks_about(const Cell& cell, int cells, const Visit& visit);

  double cell_m_, reach_m_;
  int reach_ = 0;  ///< cells between one and the farthest that is told of it
  int most_ = 0;   ///< the square of that
  BlockTable<Block> blocks_;
};

}  // namespace skein::agent
