// An index of occupied cells, for questions of distance: one bit a cell, in blocks of 4 x 4 x 4 cells found by hash.
// Only ever looked up, never walked through.
// Frame W.   Units: metres.   Threads: one.
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"
#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {

class HitBlocks {
 public:
  explicit HitBlocks(double cell_m) : cell_m_(cell_m) {}

  /// @param cell  0 begins at 0 m.   @returns true when the cell was not set before.
  bool set(const Eigen::Vector3i& cell);
  bool test(const Vector3d& p_W) const;
  std::size_t count() const { return count_; }

  /// Smallest squared distance from p to the centre of an occupied cell, if it is at most `radius`^2.
  /// With `any`, stops at the first cell within the radius.
  std::optional<double> nearest_squared(const Vector3d& p_W, double radius, bool any) const;

  /// Whether both hold the same cells.
  bool operator==(const HitBlocks& other) const { return cell_m_ == other.cell_m_ && blocks_ == other.blocks_; }

 private:
  Eigen::Vector3i cell(const Vector3d& p_W) const { return (p_W / cell_m_).array().floor().matrix().cast<int>(); }
  Vector3d centre(const Eigen::Vector3i& block, int bit) const;

  const double cell_m_;
  BlockTable<std::uint64_t> blocks_;
  std::size_t count_ = 0;
};

}  // namespace skein::agent
