// An index of free space: counts the rays that have passed each cell. Blocks of 4 x 4 x 4 cells are found by hash,
// because a ray passes several cells of a block. It offers look-up but no iteration.
// Cells have OctoMap's keys, 0 to 65535 along each axis.   Threads: one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "uav_agent/maps/block_table.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

inline constexpr int kCountedRays = 20;  ///< highest count of a cell; chosen: further rays are not counted

class RayBlocks {
 public:
  using Cell = std::array<std::uint16_t, 3>;

  static std::uint64_t block_of(const Cell& cell) {
    return std::uint64_t{cell[0]} >> 2 | std::uint64_t{cell[1]} >> 2 << 16 | std::uint64_t{cell[2]} >> 2 << 32;
  }
  static std::size_t place_of(const Cell& cell) { return (cell[0] & 3U) | (cell[1] & 3U) << 2 | (cell[2] & 3U) << 4; }
  static Cell cell_of(std::uint64_t block, std::size_t place) {
    const auto along = [&](int axis) {
      return static_cast<std::uint16_t>((block >> (16 * axis) & 0x3FFFU) << 2 | (place >> (2 * axis) & 3U));
    };
    return {along(0), along(1), along(2)};
  }
  static std::uint8_t counted(int rays) { return static_cast<std::uint8_t>(std::min(rays, kCountedRays)); }

  /// Adds counts. @param news  called as news(cell, more) for each cell whose count rises, with the increase.
  template <class News>
  void add(const PassedCells& passed, const News& news) {
    for (const auto& [key, counts] : passed.blocks) {
      PassedCells::Block& block = blocks_[key];
      for (std::size_t place = 0; place < block.size(); ++place) {
        const std::uint8_t rays = counted(block[place] + counts[place]);
        if (rays == block[place]) continue;
        news(cell_of(key, place), rays - block[place]);
        block[place] = rays;
      }
    }
  }
  int at(const Cell& cell) const {
    const PassedCells::Block* const block = blocks_.find(block_of(cell));
    return block == nullptr ? 0 : (*block)[place_of(cell)];
  }

  bool operator==(const RayBlocks&) const = default;

 private:
  BlockTable<PassedCells::Block> blocks_;
};

}  // namespace skein::agent
