// Whether this UAV's camera works, as far as the UAV can tell: a camera that fails reports nothing, and neither does a
// camera that looks at surface without interest points. So the camera counts as failed when known points are missing
// from pictures that should show them clearly: several points, from several places, and no picture shows any point.
// A single detection proves that it works.
// Frames: W world, C camera.   Units: SI.   Threads: one.   Deterministic.   Bounded by the number of known points.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::agent {

class FlockCamera {
 public:
  static constexpr double kSilentS = 1.0;  ///< a camera that has detected nothing for this long is in doubt; chosen
  static constexpr double kMissedS =
      0.25;  ///< a point that pictures should have shown for this long is missing; chosen
  static constexpr double kMostGapS = 0.5;    ///< most time between two calls of expect() in one stretch; chosen
  static constexpr std::size_t kMissing = 6;  ///< number of missing points from which the camera has failed; chosen
  /// Points must be missing from this many places, at least kApartM apart, before the camera has failed. Measured: in
  /// recorded flights in towers and cranes, a working camera misses points from at most two places 3 m apart, but from
  /// three places 1 m apart (estimated from trajectories and scenes).
  static constexpr std::size_t kPlaces = 4;
  static constexpr double kApartM = 3.0;  ///< measured, as above

  /// @param picture_s  time between two pictures.
  explicit FlockCamera(double picture_s = CameraConfig().trigger_interval_s);

  /// Call it in each exchange.   @param detects  a picture showed a point.
  void hear(bool detects, Tick now);
  /// Whether it is in doubt that the camera works. If so, call expect() with the points that it should show.
  bool in_doubt(Tick now) const { return seconds(now - heard_) >= kSilentS; }
  /// @param points  numbers of the known points that a picture taken now should show clearly.
  void expect(std::span<const std::size_t> points, const Vector3d& p_WC, Tick now);

  /// Whether the camera has failed. Never true while in_doubt() is false.
  bool failed() const { return missing_.size() >= kMissing && places_W_.size() >= kPlaces; }

 private:
  const double missed_s_;
  Tick heard_ = 0, expected_ = 0;      ///< last detection; last call of expect()
  std::map<std::size_t, Tick> since_;  ///< by point that pictures should show now: since when
  std::set<std::size_t> missing_;      ///< points that pictures did not show since the last detection
  std::vector<Vector3d> places_W_;     ///< where the camera was when they went missing; at most kPlaces
};

}  // namespace skein::agent
