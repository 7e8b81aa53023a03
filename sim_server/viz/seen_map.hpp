// A downsampled map of all key frames so far: for each cell of a grid aligned with W, the first point seen in it.
// Frame W [m]. Not thread-safe.
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
  /// Points in the order of their arrival.
  const std::vector<Eigen::Vector3f>& points() const { return points_; }

 private:
  /// The cells with a point in a block of 8 x 8 x 8 cells: a word for each z, a bit for each x and y.
  using Block = std::array<std::uint64_t, 8>;

  double cells_per_m_;
  std::unordered_map<std::uint64_t, Block> blocks_;  ///< successive points are often in the same block: one look-up
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace skein::sim::viz
