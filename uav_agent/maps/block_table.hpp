// Blocks of cells, found by number: a map is asked for them more often than for all else, mostly for some that it has
// not got. Open addressing in a table of keys, never more than half full. Only ever looked up, never walked through.
// Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace skein::agent {

template <class Block>
class BlockTable {
 public:
  /// nullptr where there is none. Good until the next operator[].
  const Block* find(std::uint64_t key) const {
    const Slot& slot = slots_[place_of(key)];
    return slot.key == key ? &slot.block : nullptr;
  }
  /// An empty one where there was none. @param key  less than 2^64 - 1.
  Block& operator[](std::uint64_t key) {
    std::size_t place = place_of(key);
    if (slots_[place].key != key) {
      if (2 * ++count_ > slots_.size()) {
        grow();
        place = place_of(key);
      }
      slots_[place].key = key;
    }
    return slots_[place].block;
  }

  /// Whether both hold the same blocks.
  bool operator==(const BlockTable& other) const {
    if (count_ != other.count_) return false;
    for (const Slot& slot : slots_) {
      if (slot.key == kNone) continue;
      const Block* const block = other.find(slot.key);
      if (block == nullptr || *block != slot.block) return false;
    }
    return true;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;  ///< 2^64 over the golden ratio: its products spread

  struct Slot {
    std::uint64_t key = kNone;
    Block block = {};
  };

  /// Where it is, or would be.
  std::size_t place_of(std::uint64_t key) const {
    std::size_t place = key * kMix >> shift_;
    while (slots_[place].key != key && slots_[place].key != kNone) place = (place + 1) & (slots_.size() - 1);
    return place;
  }

  void grow() {
    std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    --shift_;
    for (Slot& slot : old) {
      if (slot.key != kNone) slots_[place_of(slot.key)] = std::move(slot);
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(64);
  int shift_ = 64 - 6;  ///< leaves as many bits as number a slot
  std::size_t count_ = 0;
};

}  // namespace skein::agent
