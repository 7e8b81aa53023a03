// The cells of a block of 8^3 as bits: a byte for each row of eight cells along x, rows along y first, then z. So a
// question about many cells takes a few operations a row.
// Pure; threads: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace skein::agent {

inline constexpr int kRowCells = 8;  ///< format: cells of a row, and rows along y and z
using CellRows = std::array<std::uint8_t, std::size_t{kRowCells} * kRowCells>;

/// A row of cells within a row of cells that are 2^bits times as large: each cell has the bit of the one around it.
/// @param first  the large cell around the row's first cell.
inline std::uint8_t row_within(std::uint8_t large, int first, int bits) {
  unsigned row = 0;
  for (int x = 0; x < kRowCells; ++x) row |= (static_cast<unsigned>(large) >> (first + (x >> bits)) & 1U) << x;
  return static_cast<std::uint8_t>(row);
}

}  // namespace skein::agent
