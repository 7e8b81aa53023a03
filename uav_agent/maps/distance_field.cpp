#include "uav_agent/maps/distance_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

constexpr int kSide = 3 * DistanceField::kBlock;  ///< geometry: cells along an edge of a block with its neighbours
using Row = std::array<std::uint16_t, DistanceField::kBlock>;

/// Squared number of cells between two cells along an axis.
int gap_squared(int from, int to) {
  const int gap = std::max(0, std::abs(to - from) - 1);
  return gap * gap;
}

/// Squared gap from each cell of the middle block's row to the nearest occupied cell of a row. @param occupied  one bit
/// for each of the kSide cells. @param far  the result if there is none.
Row squares_in_row(std::uint32_t occupied, std::uint16_t far) {
  Row squares;
  for (int x = 0; x < DistanceField::kBlock; ++x) {
    const int at = DistanceField::kBlock + x;
    const std::uint32_t up = occupied >> at, down = occupied & ((std::uint32_t{1} << at) - 1);
    int square = far;
    if (up != 0) square = std::min(square, gap_squared(0, std::countr_zero(up)));
    if (down != 0) square = std::min(square, gap_squared(0, at + 1 - std::bit_width(down)));
    squares[static_cast<std::size_t>(x)] = static_cast<std::uint16_t>(square);
  }
  return squares;
}

void lower(Row& squares, const Row& others, int by) {
  for (std::size_t x = 0; x < squares.size(); ++x) {
    squares[x] = std::min(squares[x], static_cast<std::uint16_t>(others[x] + by));
  }
}

void for_each_about(const DistanceField::Cell& block, const auto& visit) {
  for (int i = 0; i < kCubesAround; ++i) visit(block + step_around(i));
}

}  // namespace

DistanceField::DistanceField(double cell_m, double reach_m) : cell_m_(cell_m), reach_m_(reach_m) {
  if (!(reach_m >= cell_m && reach_m <= kBlock * cell_m)) {
    throw std::invalid_argument("DistanceField: reaches 1 to 8 cells");
  }
}

/// Looks only at the block and its 26 neighbours: occupied cells beyond them are out of reach.
void DistanceField::make(const Cell& at, const OccupiedIn& occupied_in, Block& block) {
  std::array<std::array<std::uint32_t, kSide>, kSide> rows = {};  // [z][y]
  for_each_about(at, [&](const Cell& near) {
    if (changed_.find(grid_key(near)) == nullptr) return;
    const CellRows occupied = occupied_in(near);
    const Cell first = (near - at + Cell::Ones()) * kBlock;
    for (int row = 0; row < kBlock * kBlock; ++row) {
      const int y = first.y() + row % kBlock, z = first.z() + row / kBlock;
      rows[static_cast<std::size_t>(z)][static_cast<std::size_t>(y)] |=
          std::uint32_t{occupied[static_cast<std::size_t>(row)]} << first.x();
    }
  });
  block.made_at = changes_;
  // Axis by axis: squared gaps along x for each row of cells, then the minimum over y, then over z.
  Row far;
  far.fill(kFar);
  std::array<std::array<Row, kBlock>, kBlock> squares;
  for (auto& layer : squares) layer.fill(far);
  for (int from_z = 0; from_z < kSide; ++from_z) {
    std::array<Row, kBlock> layer;
    layer.fill(far);
    bool any = false;
    for (int from_y = 0; from_y < kSide; ++from_y) {
      const std::uint32_t row = rows[static_cast<std::size_t>(from_z)][static_cast<std::size_t>(from_y)];
      if (row == 0) continue;
      any = true;
      const Row along_x = squares_in_row(row, kFar);
      for (int y = 0; y < kBlock; ++y) {
        lower(layer[static_cast<std::size_t>(y)], along_x, gap_squared(from_y, kBlock + y));
      }
    }
    if (!any) continue;
    for (int z = 0; z < kBlock; ++z) {
      const int along_z = gap_squared(from_z, kBlock + z);
      for (std::size_t y = 0; y < kBlock; ++y) lower(squares[static_cast<std::size_t>(z)][y], layer[y], along_z);
    }
  }
  auto out = block.squares.begin();
  for (const auto& layer : squares) {
    for (const Row& row : layer) {
      for (const std::uint16_t square : row) *out++ = static_cast<std::uint8_t>(square);
    }
  }
}

/// Cached, because many cells of a block are queried between two changes.
std::uint64_t DistanceField::newest_change(const Cell& at) {
  Newest& newest = newest_[grid_key(at)];
  if (newest.changes == changes_) return newest.at;
  newest.changes = changes_;
  for_each_about(at, [&](const Cell& near) {
    if (const std::uint64_t* const changed = changed_.find(grid_key(near))) newest.at = std::max(newest.at, *changed);
  });
  return newest.at;
}

double DistanceField::distance_m(const Cell& cell, const OccupiedIn& occupied_in) {
  const Cell at = block_of(cell);
  const std::uint64_t newest = newest_change(at);
  if (newest == 0) return reach_m_;
  Block& block = blocks_[grid_key(at)];
  if (block.made_at < newest) make(at, occupied_in, block);
  constexpr int kIn = kBlock - 1;
  const int place = (cell.x() & kIn) | (cell.y() & kIn) << kBlockBits | (cell.z() & kIn) << 2 * kBlockBits;
  const double square = block.squares[static_cast<std::size_t>(place)];
  return std::min(reach_m_, cell_m_ * std::sqrt(square));
}

}  // namespace skein::agent
