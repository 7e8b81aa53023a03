// An index of occupied cells for distance queries: one bit per cell, blocks of 4 x 4 x 4 cells, regions of 4 x 4 x 4
// blocks in a hash table. It offers look-up but no iteration.
// Frame W.   Units: metres.   Threads: one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/types.hpp"
#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {

class HitBlocks {
 public:
  explicit HitBlocks(double cell_m) : cell_m_(cell_m) {}

  /// The lowest corners of block (0, 0, 0) and of cell (0, 0, 0) are the origin of W.
  static Eigen::Vector3i block_of(const Eigen::Vector3i& cell) { return {cell.x() >> 2, cell.y() >> 2, cell.z() >> 2}; }
  /// Index of a cell within its block, 0 to 63, x first.
  static unsigned place_of(const Eigen::Vector3i& cell) {
    return static_cast<unsigned>((cell.x() & 3) | (cell.y() & 3) << 2 | (cell.z() & 3) << 4);
  }

  /// The cell with this index within a block; the inverse of place_of().
  static Eigen::Vector3i cell_at(const Eigen::Vector3i& block, int bit);

  /// Adds occupied cells. @param cells  one bit per cell, at place_of().   @returns the bits that were not set before.
  std::uint64_t add(const Eigen::Vector3i& block, std::uint64_t cells);
  bool test(const Vector3d& p_W) const;
  std::size_t count() const { return count_; }

  /// Smallest squared distance from p to the centre of an occupied cell, if it is at most `radius`^2.
  /// With `any`, stops at the first cell within the radius.
  std::optional<double> nearest_squared(const Vector3d& p_W, double radius, bool any) const;

  /// Whether both hold the same cells.
  bool operator==(const HitBlocks& other) const { return cell_m_ == other.cell_m_ && regions_ == other.regions_; }

 private:
  using Region = std::array<std::uint64_t, 64>;

  /// Rounds down without floor(), which is a function call on the target processors, and took most of a query's time.
  Eigen::Vector3i cell(const Vector3d& p_W) const {
    const auto down = [](double along) {
      const int whole = static_cast<int>(along);
      return whole - static_cast<int>(whole > along);
    };
    return {down(p_W.x() / cell_m_), down(p_W.y() / cell_m_), down(p_W.z() / cell_m_)};
  }
  Vector3d centre(const Eigen::Vector3i& block, int bit) const;

  const double cell_m_;
  BlockTable<Region> regions_;
  std::size_t count_ = 0;
};

}  // namespace skein::agent
