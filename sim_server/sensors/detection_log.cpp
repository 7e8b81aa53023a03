#include "sim_server/sensors/detection_log.hpp"

#include <algorithm>
#include <utility>

namespace skein::sim {

InterestPoint DetectionLog::Entry::as_told(const InterestPoint& point_W) const {
  if (!X_told_W) return point_W;
  return {(*X_told_W * point_W.p_W.cast<double>()).cast<float>(),
          (X_told_W->linear() * point_W.n_W.cast<double>()).cast<float>()};
}

void DetectionLog::add(const Capture& capture, const std::optional<Isometry3d>& X_told_W) {
  for (const Detection& detection : capture.detections) {
    const std::uint32_t number = order_.number(detection.point);
    if (number == entries_.size()) entries_.push_back({.point = detection.point});
    entries_[number].best = detection.best;
    entries_[number].X_told_W = X_told_W;
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
