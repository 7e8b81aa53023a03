// What all key frames have shown so far, thinned out: in each cell of a grid aligned with W, the first point that was
// seen there. Frame W [m]. Not thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/types.hpp"

namespace skein::sim::viz {

class SeenMap {
 public:
  /// @param cell_m  edge of a cell, > 0.
  explicit SeenMap(double cell_m) : cells_per_m_(1.0 / cell_m) {}

  /// @param points_W  less than 2^23 cells from the origin. @returns whether the map has grown.
  bool add(std::span<const Eigen::Vector3f> points_W);
  /// In the order in which they came.
  const std::vector<Eigen::Vector3f>& points() const { return points_; }

 private:
  /// Which cells of a block of 8 x 8 x 8 have a point: a word for each z, a bit for each x and y.
  using Block = std::array<std::uint64_t, 8>;

  double cells_per_m_;
  std::unordered_map<std::uint64_t, Block> blocks_;  ///< points come in rows: one look-up does for several
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace skein::sim::viz
