// Translates the numbers by which UAVs name interest points in their reports into indices of the scene. Each UAV
// numbers the points in the order in which it first saw them (core/scoring/detection_order.hpp). The ledger, which no
// UAV receives, has these points in the same order, so the station can assign the same numbers.
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
  /// Replaces a number that its UAV never gave: no point has this index, so that the report equals no ledger entry.
  static constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

  /// @param uavs  size of the fleet.
  explicit PointNames(std::size_t uavs) : of_uav_(uavs) {}

  /// Takes the new entries of the ledger. @param ledger  from its beginning, without gaps; known entries are skipped.
  void follow(const std::vector<LedgerEntry>& ledger);
  /// Replaces the numbers in a report with indices. follow() must have had the ledger's entry of this report before.
  void resolve(CaptureReport& report) const;

 private:
  std::vector<DetectionOrder> of_uav_;
  std::size_t followed_ = 0;
};

}  // namespace skein::station
