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

/// The same, to the nearest cell of a block.
int gap_squared_to_block(int cell, int first, int size) {
  return gap_squared(cell, std::clamp(cell, first, first + size - 1));
}

}  // namespace

DistanceField::DistanceField(double cell_m, double reach_m)
    : cell_m_(cell_m), reach_m_(reach_m), reach_(static_cast<int>(std::ceil(reach_m / cell_m))) {
  most_ = reach_ * reach_;
  if (reach_ < 1 || most_ >= kFar) throw std::invalid_argument("DistanceField: reaches 1 to 15 cells");
}

template <class Visit>
void DistanceField::blocks_about(const Cell& cell, int cells, const Visit& visit) {
  const auto first = [&](int axis) { return (cell[axis] - cells) >> kBlockBits; };
  const auto last = [&](int axis) { return (cell[axis] + cells) >> kBlockBits; };
  for (int z = first(2); z <= last(2); ++z) {
    for (int y = first(1); y <= last(1); ++y) {
      for (int x = first(0); x <= last(0); ++x) visit(Cell(x, y, z));
    }
  }
}

void DistanceField::add(const Cell& cell) {
  blocks_about(cell, reach_, [&](const Cell& at) {
    const Cell corner = at * kBlock;
    int nearest = 0;
    for (int axis = 0; axis < 3; ++axis) nearest += gap_squared_to_block(cell[axis], corner[axis], kBlock);
    if (nearest > most_) return;
    std::array<int, kBlock> along_x;
    for (int x = 0; x < kBlock; ++x) along_x[static_cast<std::size_t>(x)] = gap_squared(cell.x(), corner.x() + x);
    auto row = blocks_[grid_key(at)].squares.begin();
    for (int z = 0; z < kBlock; ++z) {
      const int along_z = gap_squared(cell.z(), corner.z() + z);
      for (int y = 0; y < kBlock; ++y, row += kBlock) {
        const int across = along_z + gap_squared(cell.y(), corner.y() + y);
        if (across > most_) continue;
        for (std::size_t x = 0; x < kBlock; ++x) {
          const int square = across + along_x[x];
          row[x] = std::min(row[x], static_cast<std::uint8_t>(square > most_ ? int{kFar} : square));
        }
      }
    }
  });
}

void DistanceField::remove(std::span<const Cell> cells, const OccupiedIn& occupied_in) {
  // What was told by these is forgotten, and all who are near enough tell again.
  for (const Cell& cell : cells) {
    blocks_about(cell, reach_, [&](const Cell& at) {
      if (blocks_.find(grid_key(at)) != nullptr) blocks_[grid_key(at)] = {};
    });
  }
  std::vector<Cell> teller_blocks;
  for (const Cell& cell : cells) {
    blocks_about(cell, 2 * reach_ + kBlock, [&](const Cell& at) { teller_blocks.push_back(at); });
  }
  const auto before = [](const Cell& a, const Cell& b) { return grid_key(a) < grid_key(b); };
  std::ranges::sort(teller_blocks, before);
  const auto repeated = std::ranges::unique(teller_blocks);
  teller_blocks.erase(repeated.begin(), repeated.end());
  for (const Cell& at : teller_blocks) {
    for (const Cell& cell : occupied_in(at)) add(cell);
  }
}

double DistanceField::distance_m(const Cell& cell) const {
  const Block* const block =
      blocks_.find(grid_key({cell.x() >> kBlockBits, cell.y() >> kBlockBits, cell.z() >> kBlockBits}));
  if (block == nullptr) return reach_m_;
  constexpr int kIn = kBlock - 1;
  const int place = (cell.x() & kIn) | (cell.y() & kIn) << kBlockBits | (cell.z() & kIn) << 2 * kBlockBits;
  const std::uint8_t square = block->squares[static_cast<std::size_t>(place)];
  return square == kFar ? reach_m_ : std::min(reach_m_, cell_m_ * std::sqrt(static_cast<double>(square)));
}

}  // namespace skein::agent
