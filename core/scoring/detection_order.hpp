// Numbers of the interest points that one UAV has seen, in the order in which it first saw them. On-board software
// receives these numbers, never the index of a point in the scene, which would reveal how many points it has not seen.
// The simulator assigns the numbers; the station derives the same numbers from the ledger, which has the same order.
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
  /// The point with a number; nullopt if no point has it yet.
  std::optional<std::uint32_t> point(std::uint32_t number) const;
  /// Number of points that have a number.
  std::size_t size() const { return points_.size(); }

 private:
  std::map<std::uint32_t, std::uint32_t> numbers_;  ///< by point
  std::vector<std::uint32_t> points_;               ///< by number
};

}  // namespace skein
