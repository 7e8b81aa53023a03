#include "station/point_names.hpp"

namespace skein::station {

void PointNames::follow(const std::vector<LedgerEntry>& ledger) {
  for (; followed_ < ledger.size(); ++followed_) {
    const LedgerEntry& entry = ledger[followed_];
    for (const CapturePoint& point : entry.capture.points) of_uav_[entry.uav].number(point.index);
  }
}

void PointNames::resolve(CaptureReport& report) const {
  for (CapturePoint& point : report.points) {
    const auto known = report.uav < of_uav_.size() ? of_uav_[report.uav].point(point.index) : std::nullopt;
    point.index = known.value_or(kNoPoint);
  }
}

}  // namespace skein::station
