// A hash table of blocks of cells: looking up a block is a map's most frequent query, mostly for a block that is not
// there. Open addressing in a table of keys that is never more than half full; the blocks are in a separate array, in
// order of insertion. It offers look-up but no iteration, so no result can depend on the hash order.
// Threads: one.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace skein::agent {

/// Key of a cell or block whose index along each axis is within (-2^20, 2^20): 21 bits an axis.
inline std::uint64_t grid_key(const Eigen::Vector3i& at) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;  // format: three times 21 bits in one key
  const auto along = [&](int axis) { return static_cast<std::uint64_t>(at[axis]) & kMask; };
  return along(0) | along(1) << 21 | along(2) << 42;
}

/// Index of the cell that contains `cell` on a grid 2^bits times as coarse.
inline Eigen::Vector3i shifted(const Eigen::Vector3i& cell, int bits) {
  return {cell.x() >> bits, cell.y() >> bits, cell.z() >> bits};
}

/// Appends a default element. Allocates a quarter more than is needed in place of as much again: maps of a fleet in one
/// process hold most of its memory.
template <class Element>
Element& append(std::vector<Element>& elements) {
  constexpr std::size_t kLeast = 8;                                                                    ///< memory
  if (const auto n = elements.size(); n == elements.capacity()) elements.reserve(n + n / 4 + kLeast);  // memory
  return elements.emplace_back();
}

template <class Block>
class BlockTable {
 public:
  /// The block with this key, or nullptr. The pointer is valid until the next operator[] or clear().
  const Block* find(std::uint64_t key) const {
    const Slot& slot = slots_[place_of(key)];
    return slot.key == key ? &blocks_[slot.block] : nullptr;
  }
  /// The block with this key; inserts a default one if there is none. @param key  less than 2^64 - 1.
  Block& operator[](std::uint64_t key) {
    if (const Slot& slot = slots_[place_of(key)]; slot.key == key) return blocks_[slot.block];
    if (2 * (blocks_.size() + 1) > slots_.size()) grow();
    slots_[place_of(key)] = {key, blocks_.size()};
    return append(blocks_);
  }

  /// Removes all blocks, but keeps the memory for later ones.
  void clear() {
    std::ranges::fill(slots_, Slot());
    blocks_.clear();
  }

  /// Memory allocated [bytes], without what the blocks themselves point to.
  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot) + blocks_.capacity() * sizeof(Block); }

  /// Whether both hold the same keys with equal blocks. The order of insertion does not matter.
  bool operator==(const BlockTable& other) const {
    return blocks_.size() == other.blocks_.size() && std::ranges::all_of(slots_, [&](const Slot& slot) {
             if (slot.key == kNone) return true;
             const Block* const block = other.find(slot.key);
             return block != nullptr && *block == blocks_[slot.block];
           });
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;  ///< formula: 2^64 / golden ratio; spreads keys

  struct Slot {
    std::uint64_t key = kNone;
    std::size_t block = 0;  ///< index in blocks_
  };

  /// Index of the slot that holds this key, or of the free slot where it would be inserted.
  std::size_t place_of(std::uint64_t key) const {
    std::size_t place = key * kMix >> shift_;
    while (slots_[place].key != key && slots_[place].key != kNone) place = (place + 1) & (slots_.size() - 1);
    return place;
  }

  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    --shift_;
    for (const Slot& slot : old) {
      if (slot.key != kNone) slots_[place_of(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(64);  ///< memory: doubled when it is full
  /// Formula: 64 - log2(slots_.size()). It leaves the top bits of the product as the slot's index.
  int shift_ = 64 - 6;
  std::vector<Block> blocks_;
};

}  // namespace skein::agent
