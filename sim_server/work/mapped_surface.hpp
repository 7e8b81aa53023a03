// Finds the interest points on surface that a key frame shows: those with one of its hits nearby.
// Frame W.   Units: m.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/scenario/scene.hpp"

namespace skein::sim {

/// Immutable; safe from any thread.
class MappedSurface {
 public:
  /// Greatest distance between a hit and a point [m]. Key frames keep one hit for each cell of 0.5 m, so any surface
  /// that is shown has a hit within this distance.
  static constexpr float kNear = 0.75F;

  /// @param points  must outlive this.
  explicit MappedSurface(const std::vector<InterestPoint>& points);

  /// @returns by interest point, whether one of the hits is within kNear of it.
  std::vector<bool> shown_by(std::span<const Eigen::Vector3f> hits_W) const;

 private:
  static std::uint64_t cell_of(const Eigen::Vector3i& cell);

  const std::vector<InterestPoint>& points_;
  /// By cell (edge kNear): the points in this cell and its 26 neighbours. Never iterated.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> near_;
};

}  // namespace skein::sim
