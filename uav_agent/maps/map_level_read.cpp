// What a level of the map knows of its cells, one by one and block by block.
#include <bit>
#include <cstring>
#include <limits>

#include "uav_agent/maps/map_level.hpp"

namespace skein::agent {
namespace {

/// One bit for each of eight cells: whether it has this state.
std::uint8_t row_of(const Space* cells, Space space) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint64_t kOnes = 0x0101010101010101;    // format: 1 in each byte
  constexpr std::uint64_t kGather = 0x0102040810204080;  // format: moves bit 0 of byte i to bit 56 + i
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, cells, sizeof(bytes));
  const std::uint64_t differs = bytes ^ (kOnes * static_cast<std::uint64_t>(space));
  const std::uint64_t equal = ((differs | differs >> 1) & kOnes) ^ kOnes;  // Space has two bits
  return static_cast<std::uint8_t>(equal * kGather >> 56);
}

}  // namespace

MapLevel::Known MapLevel::known(const Cell& cell) const {
  const Slot* const slot = slots_.find(grid_key(block_of(cell)));
  if (slot == nullptr || slot->number == kNone) return {};
  if (slot->number == kAllFree) return {Space::free, slot->teller};
  const Block& block = blocks_[slot->number - kFirst];
  const std::size_t place = place_of(cell);
  return {block.space[place], block.teller[place]};
}

MapLevel::Structure MapLevel::structure_in(const Cell& block) const {
  const Slot* const slot = slots_.find(grid_key(block));
  if (slot == nullptr || slot->number < kFirst) return {};
  return Structure(&blocks_[slot->number - kFirst]);
}

void MapLevel::read(const Cell& block, std::array<Known, kCells>& known) const {
  const Slot* const slot = slots_.find(grid_key(block));
  if (slot == nullptr || slot->number == kNone) return known.fill({});
  if (slot->number == kAllFree) return known.fill({Space::free, slot->teller});
  const Block& read = blocks_[slot->number - kFirst];
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = {read.space[i], read.teller[i]};
}

CellRows MapLevel::rows(const Cell& block, Space space) const {
  CellRows rows;
  const Slot* const slot = slots_.find(grid_key(block));
  if (slot == nullptr || slot->number < kFirst) {
    const Space all = slot != nullptr && slot->number == kAllFree ? Space::free : Space::unknown;
    rows.fill(all == space ? std::numeric_limits<std::uint8_t>::max() : std::uint8_t{0});
    return rows;
  }
  const Block& read = blocks_[slot->number - kFirst];
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row_of(&read.space[row * kRowCells], space);
  return rows;
}

}  // namespace skein::agent
