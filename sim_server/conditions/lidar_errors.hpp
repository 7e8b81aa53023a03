// What a LiDAR measures of the ranges that its beams meet, on a day that is not ideal.
//
//   Noise: normal, with a deviation of so much a metre.
//   Weak returns: the power that comes back goes with reflectivity times cos(incidence) over the square of the range,
//     and a perpendicular white surface is just seen at `full_range_m`. So a surface is seen up to
//     full_range_m sqrt(reflectivity cos(incidence)): dark, wet and slanted ones, and the edges of thin members, vanish
//     first. The incidence follows from the ranges of the two beams beside, as the scan shows the surface.
//   Rain and dust: a beam meets a drop before it meets anything else.
// Units: SI.  Pure; threads: one.  The same seed and scan give the same numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/conditions.hpp"
#include "core/scenario.hpp"

namespace skein::sim {

class LidarErrors {
 public:
  LidarErrors(const LidarConditions& conditions, const LidarConfig& lidar, std::uint64_t seed, UavIndex uav)
      : conditions_(conditions), lidar_(lidar), seed_(seed), uav_(uav) {}

  bool any() const { return conditions_.on(); }
  /// @param ranges  of all beams, ring by ring; infinite: they meet nothing.
  /// @returns what is measured in their place; infinite: no return.
  const std::vector<double>& measure(std::uint64_t scan, std::span<const double> ranges);
  /// Cosine of the angle between a beam and the normal of what it meets, in the plane of its ring; 1 where neighbours
  /// met nothing to tell by.
  double cos_incidence(std::span<const double> ranges, std::size_t beam) const;

 private:
  LidarConditions conditions_;
  LidarConfig lidar_;
  std::uint64_t seed_;
  UavIndex uav_;
  std::vector<double> measured_;
};

}  // namespace skein::sim
