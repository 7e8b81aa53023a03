// What one UAV calls the interest points that it has seen: it numbers them in the order in which it first saw them.
// On-board software never hears the index of a point in the scene, which would tell it what it has not seen. The
// simulator gives these numbers, and the station finds the points again by the ledger, which has the same order.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace skein {

/// Not thread-safe.
class DetectionOrder {
 public:
  /// The number of a point: 0, 1, 2, ... A point that is new gets the next one.
  std::uint32_t number(std::uint32_t point);
  /// The point of a number; nullopt when none has it yet.
  std::optional<std::uint32_t> point(std::uint32_t number) const;
  /// Points that have a number.
  std::size_t size() const { return points_.size(); }

 private:
  std::map<std::uint32_t, std::uint32_t> numbers_;  ///< by point
  std::vector<std::uint32_t> points_;               ///< by number
};

}  // namespace skein
