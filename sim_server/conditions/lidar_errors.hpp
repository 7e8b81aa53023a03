// The ranges that a LiDAR measures under conditions that are not ideal, computed from the true ranges of its beams.
//
//   Noise: normal. Its standard deviation grows with the range and with the tangent of the incidence angle, because the
//     beam's footprint on a slanted surface extends along the beam (lidar_sigma_m() in core/scenario/conditions.hpp).
//   Weak returns: the returned power is proportional to reflectivity times cos(incidence) over the square of the range,
//     and the LiDAR just sees a perpendicular white surface at `full_range_m`. So it sees a surface up to
//     full_range_m sqrt(reflectivity cos(incidence)), and loses dark, wet and slanted surfaces, and the edges of thin
//     members, first. The incidence angle is estimated from the ranges of the two adjacent beams of the scan.
//   Rain and dust: a drop or a dust particle may return a beam before the beam reaches a surface.
// The random number for a beam's noise depends only on seed, UAV, scan and the beam's index.
// Units: SI.  Pure; threads: one.  The same seed and scan give the same numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scenario/conditions.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::sim {

class LidarErrors {
 public:
  LidarErrors(const LidarConditions& conditions, const LidarConfig& lidar, std::uint64_t seed, UavIndex uav)
      : conditions_(conditions), lidar_(lidar), seed_(seed), uav_(uav) {}

  /// @param conditions  for the scans that follow.
  void change(const LidarConditions& conditions) { conditions_ = conditions; }
  bool any() const { return conditions_.on(); }
  /// @param ranges  true ranges of all beams, ring by ring; infinite: the beam hits nothing.
  /// @returns the measured ranges of the same beams, valid until the next call; infinite: no return.
  const std::vector<double>& measure(std::uint64_t scan, std::span<const double> ranges);
  /// Cosine of the angle between a beam and the normal of the surface that it hits, in the plane of its ring; 1 if both
  /// adjacent beams hit nothing.
  double cos_incidence(std::span<const double> ranges, std::size_t beam) const;

 private:
  /// Least difference between the range of a beam and that of an adjacent beam; 0 if both adjacent beams hit nothing.
  double rise(std::span<const double> ranges, std::size_t beam) const;
  void measure_surfaces(std::uint64_t scan, std::span<const double> ranges);
  void add_clutter(std::uint64_t scan, std::span<const double> ranges);

  LidarConditions conditions_;
  LidarConfig lidar_;
  std::uint64_t seed_;
  UavIndex uav_;
  std::vector<double> measured_;
};

}  // namespace skein::sim
