#include "uav_agent/maps/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace skein::agent {
namespace {

/// Of the cells between two along an axis.
int gap_squared(int from, int to) {
  const int gap = std::max(0, std::abs(to - from) - 1);
  return gap * gap;
}

template <class Visit>
void for_each_about(const DistanceField::Cell& block, const Visit& visit) {
  for (int i = 0; i < 27; ++i) visit(block + DistanceField::Cell(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
}

}  // namespace

DistanceField::DistanceField(double cell_m, double reach_m) : cell_m_(cell_m), reach_m_(reach_m) {
  if (!(reach_m >= cell_m && reach_m <= kBlock * cell_m)) {
    throw std::invalid_argument("DistanceField: reaches 1 to 8 cells");
  }
}

/// All that is within reach lies in the blocks about it.
void DistanceField::make(const Cell& at, const OccupiedIn& occupied_in, Block& block) {
  occupied_.clear();
  for_each_about(at, [&](const Cell& near) {
    if (changed_.find(grid_key(near)) != nullptr) occupied_in(near, occupied_);
  });
  block.made_at = changes_;
  block.squares.fill(kFar);
  const Cell corner = at * kBlock;
  for (const Cell& cell : occupied_) {
    std::array<int, kBlock> along_x;
    for (int x = 0; x < kBlock; ++x) along_x[static_cast<std::size_t>(x)] = gap_squared(cell.x(), corner.x() + x);
    auto row = block.squares.begin();
    for (int z = 0; z < kBlock; ++z) {
      const int along_z = gap_squared(cell.z(), corner.z() + z);
      for (int y = 0; y < kBlock; ++y, row += kBlock) {
        const int across = along_z + gap_squared(cell.y(), corner.y() + y);
        for (std::size_t x = 0; x < kBlock; ++x) {
          row[x] = static_cast<std::uint8_t>(std::min<int>(row[x], across + along_x[x]));
        }
      }
    }
  }
}

double DistanceField::distance_m(const Cell& cell, const OccupiedIn& occupied_in) {
  const Cell at = block_of(cell);
  std::uint64_t newest = 0;
  for_each_about(at, [&](const Cell& near) {
    if (const std::uint64_t* const changed = changed_.find(grid_key(near))) newest = std::max(newest, *changed);
  });
  if (newest == 0) return reach_m_;
  Block& block = blocks_[grid_key(at)];
  if (block.made_at < newest) make(at, occupied_in, block);
  constexpr int kIn = kBlock - 1;
  const int place = (cell.x() & kIn) | (cell.y() & kIn) << kBlockBits | (cell.z() & kIn) << 2 * kBlockBits;
  const double square = block.squares[static_cast<std::size_t>(place)];
  return std::min(reach_m_, cell_m_ * std::sqrt(square));
}

}  // namespace skein::agent
