// Numbers the UAVs with which this UAV shares its map. Maps and messages have room for kMostSlots of them, fewer than a
// large fleet has; so in such a fleet a UAV gets its number, the slot, when this UAV first meets it.
// Pure.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace skein::agent {

class Acquaintances {
 public:
  /// Format: a set of tellers has 128 bits (told_chunks.hpp), one of them for the UAV itself.
  static constexpr std::size_t kMostSlots = 127;

  /// @param fleet  number of UAVs. A fleet of at most kMostSlots has the slot i for UAV i from the beginning.
  explicit Acquaintances(std::size_t fleet) : slots_(fleet, kNone), fixed_(fleet <= kMostSlots) {}

  std::size_t fleet() const { return slots_.size(); }
  /// @returns the slot of a UAV of the fleet; nullopt: this UAV has not met it, or met kMostSlots others before.
  std::optional<std::size_t> slot_of(std::size_t uav) const {
    if (fixed_) return uav;
    return slots_.at(uav) == kNone ? std::nullopt : std::optional<std::size_t>(slots_[uav]);
  }
  /// Gives a UAV of the fleet the next slot, unless it has one. @returns as slot_of().
  std::optional<std::size_t> meet(std::size_t uav) {
    if (!fixed_ && slots_.at(uav) == kNone && met_.size() < kMostSlots) {
      slots_[uav] = static_cast<std::uint8_t>(met_.size());
      met_.push_back(uav);
    }
    return slot_of(uav);
  }
  /// Number of slots that are given.
  std::size_t slots() const { return fixed_ ? slots_.size() : met_.size(); }
  /// @param slot  less than slots().
  std::size_t uav_of(std::size_t slot) const { return fixed_ ? slot : met_.at(slot); }

 private:
  static constexpr std::uint8_t kNone = std::numeric_limits<std::uint8_t>::max();

  std::vector<std::uint8_t> slots_;  ///< by UAV; unused if fixed_
  std::vector<std::size_t> met_;     ///< by slot; likewise
  bool fixed_;
};

}  // namespace skein::agent
