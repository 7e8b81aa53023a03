// What one UAV's camera has shown it so far, as on-board software may know it: points in the order in which it first
// saw them, each with the best score of this UAV. Pure. Not thread-safe.
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
    std::uint32_t point = 0;                  ///< index in the scene: for the server alone
    float best = 0.0F;                        ///< best score of this UAV so far
    std::optional<Isometry3d> X_told_W = {};  ///< where the UAV took it to be when it last saw it; nullopt: where it is

    InterestPoint as_told(const InterestPoint& point_W) const;
  };

  /// A capture of this UAV's camera, in the order in which they were taken.
  /// @param X_told_W  takes what is in W to where the UAV sees it.
  void add(const Capture& capture, const std::optional<Isometry3d>& X_told_W = {});

  /// By number: the order in which this UAV first saw them.
  std::span<const Entry> entries() const { return entries_; }
  /// Numbers of all points that captures have shown since the last call, ascending.
  std::vector<std::uint32_t> take_seen();
  /// The report as it is handed to the UAV: numbers in the place of indices.
  /// @param report  of a capture that was added.
  CaptureReport as_told(CaptureReport report);

 private:
  DetectionOrder order_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> seen_;
};

}  // namespace skein::sim
