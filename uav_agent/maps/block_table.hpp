// Blocks of cells, found by number: a map is asked for them more often than for all else, mostly for some that it has
// not got. Open addressing in a table of keys, never more than half full; blocks stand beside it, in the order in which
// they came. Only ever looked up, never walked through.
// Threads: one.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace skein::agent {

/// Of a cell or block that is less than 2^20 from the origin along each axis.
inline std::uint64_t grid_key(const Eigen::Vector3i& at) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  const auto along = [&](int axis) { return static_cast<std::uint64_t>(at[axis]) & kMask; };
  return along(0) | along(1) << 21 | along(2) << 42;
}

/// The cell about it that is 2^bits times as large.
inline Eigen::Vector3i shifted(const Eigen::Vector3i& cell, int bits) {
  return {cell.x() >> bits, cell.y() >> bits, cell.z() >> bits};
}

template <class Block>
class BlockTable {
 public:
  /// nullptr where there is none. Good until the next operator[].
  const Block* find(std::uint64_t key) const {
    const Slot& slot = slots_[place_of(key)];
    return slot.key == key ? &blocks_[slot.block] : nullptr;
  }
  /// An empty one where there was none. @param key  less than 2^64 - 1.
  Block& operator[](std::uint64_t key) {
    if (const Slot& slot = slots_[place_of(key)]; slot.key == key) return blocks_[slot.block];
    if (2 * (blocks_.size() + 1) > slots_.size()) grow();
    slots_[place_of(key)] = {key, blocks_.size()};
    return blocks_.emplace_back();
  }

  /// Of all blocks; their memory is kept for others.
  void clear() {
    std::ranges::fill(slots_, Slot());
    blocks_.clear();
  }

  /// Of memory.
  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot) + blocks_.capacity() * sizeof(Block); }

  /// Whether both hold the same blocks.
  bool operator==(const BlockTable& other) const {
    return blocks_.size() == other.blocks_.size() && std::ranges::all_of(slots_, [&](const Slot& slot) {
             if (slot.key == kNone) return true;
             const Block* const block = other.find(slot.key);
             return block != nullptr && *block == blocks_[slot.block];
           });
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;  ///< 2^64 over the golden ratio: its products spread

  struct Slot {
    std::uint64_t key = kNone;
    std::size_t block = 0;  ///< in blocks_
  };

  /// Where it is, or would be.
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

  std::vector<Slot> slots_ = std::vector<Slot>(64);
  int shift_ = 64 - 6;  ///< leaves as many bits as number a slot
  std::vector<Block> blocks_;
};

}  // namespace skein::agent
