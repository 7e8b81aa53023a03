#include "sim_server/sensors/detection_log.hpp"

#include <algorithm>
#include <utility>

namespace skein::sim {

void DetectionLog::add(const Capture& capture) {
  for (const Detection& detection : capture.detections) {
    const std::uint32_t number = order_.number(detection.point);
    if (number == entries_.size()) entries_.push_back({detection.point, 0.0F});
    entries_[number].best = detection.best;
    seen_.push_back(number);
  }
}

std::vector<std::uint32_t> DetectionLog::take_seen() {
  std::ranges::sort(seen_);
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
  return std::exchange(seen_, {});
}

CaptureReport DetectionLog::as_told(CaptureReport report) {
  for (CapturePoint& point : report.points) point.index = order_.number(point.index);
  return report;
}

}  // namespace skein::sim
