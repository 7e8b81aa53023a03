// What UAVs call the interest points in their reports, and which points these are. Each UAV numbers what it has seen
// (core/scoring/detection_order.hpp); the ledger, which it never sees, tells the station the same in the same order.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/scoring/detection_order.hpp"
#include "core/scoring/score_table.hpp"

namespace skein::station {

/// Not thread-safe.
class PointNames {
 public:
  /// In the place of a number that its UAV never gave: the index of no point, so that the report equals no entry.
  static constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

  /// @param uavs  size of the fleet.
  explicit PointNames(std::size_t uavs) : of_uav_(uavs) {}

  /// The next entries of the ledger. @param ledger  from its beginning, without gaps; what is known is passed over.
  void follow(const std::vector<LedgerEntry>& ledger);
  /// Puts indices in the place of a report's numbers. What its UAV has reported must have been followed.
  void resolve(CaptureReport& report) const;

 private:
  std::vector<DetectionOrder> of_uav_;
  std::size_t followed_ = 0;
};

}  // namespace skein::station
