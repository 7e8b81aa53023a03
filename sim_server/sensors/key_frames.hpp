// Key frames: the few scans that an explorer publishes as its map, each as one downsampled cloud.
// Rules: the first scan; then a scan more than 1 s after the last key frame when the nearest key frame is more than 2 m
// away, or when all of the five nearest differ by at least 10 degrees in yaw.
// Frames: W world, B body.   Units: SI, radians.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim_server/sensors/lidar.hpp"

namespace skein::sim {

struct KeyFrame {
  std::uint64_t number = 0;  ///< 0, 1, ... for this UAV
  Tick tick = 0;
  Isometry3d X_WB = Isometry3d::Identity();
  std::vector<Eigen::Vector3f> points_W;  ///< downsampled [m]
};

/// Downsamples a cloud: of the points in each cell of a grid aligned with W, keeps the one nearest to the cell's centre
/// (the earlier one in a tie).   @param cell_m  edge of a cell, > 0.   @returns the kept points, in the cloud's order.
std::vector<Eigen::Vector3f> sample_uniformly(std::span<const Eigen::Vector3f> points_W, double cell_m);

/// Selects the key frames of one UAV. Not thread-safe.
class KeyFrameSelector {
 public:
  static constexpr Tick kMinAge = kTicksPerSecond;        ///< time since the last key frame must exceed this
  static constexpr double kMinDistance = 2.0;             ///< distance to the nearest key frame must exceed this [m]
  static constexpr double kMinYaw = 0.17453292519943295;  ///< 10 degrees
  static constexpr std::size_t kNeighbours = 5;           ///< nearest key frames whose yaw counts
  static constexpr double kCell = 0.5;                    ///< edge of a cell for downsampling [m]

  /// Whether a scan from this pose would become a key frame.
  bool wants(Tick tick, const Isometry3d& X_WB) const { return wanted(pose_of(tick, X_WB)); }
  /// @returns the key frame that this scan becomes, or nullopt. X_WB is the body's pose at the scan's tick.
  std::optional<KeyFrame> offer(const LidarScan& scan, const Isometry3d& X_WB);

 private:
  struct Pose {
    Tick tick;
    Vector3d p_WB;
    double yaw;
  };
  static Pose pose_of(Tick tick, const Isometry3d& X_WB);
  bool wanted(const Pose& pose) const;

  std::vector<Pose> kept_;
};

}  // namespace skein::sim
