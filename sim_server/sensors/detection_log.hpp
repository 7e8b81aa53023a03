// The detections of one UAV's camera so far, as the UAV's software may know them: interest points in the order in which
// the camera first saw them, each with this UAV's best score. Pure. Not thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/scoring/detection_order.hpp"
#include "core/scoring/score_table.hpp"
#include "sight/camera.hpp"

namespace skein::sim {

class DetectionLog {
 public:
  struct Entry {
    std::uint32_t point = 0;                  ///< index in the scene; only the server knows it
    float best = 0.0F;                        ///< best score of this UAV so far
    std::optional<Isometry3d> X_told_W = {};  ///< W to the frame `told` when it was last seen; nullopt: W itself

    /// The point in the frame `told`.
    InterestPoint as_told(const InterestPoint& point_W) const;
  };

  /// Adds a capture of this UAV's camera. Call it in the order of the captures.
  /// @param X_told_W  from W to the frame `told` of the UAV's odometry; nullopt: W itself.
  void add(const Capture& capture, const std::optional<Isometry3d>& X_told_W = {});

  /// Entries by the point's number: numbers count the points in the order in which this UAV first saw them.
  std::span<const Entry> entries() const { return entries_; }
  /// Numbers of all points that captures have shown since the last call, ascending.
  std::vector<std::uint32_t> take_seen();
  /// The report as the UAV gets it: with this UAV's numbers of the points instead of their indices in the scene.
  /// @param report  of a capture that was added.
  CaptureReport as_told(CaptureReport report);

 private:
  DetectionOrder order_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> seen_;
};

}  // namespace skein::sim
