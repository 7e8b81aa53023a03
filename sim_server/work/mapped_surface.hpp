// Which interest points stand for surface that a key frame shows: those that one of its hits is near to.
// Frame W.   Units: m.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

/// Immutable; safe from any thread.
class MappedSurface {
 public:
  /// Key frames keep a hit for each cell of 0.5 m: surface that is shown at all has one nearer than that.
  static constexpr float kNear = 0.75F;

  /// @param points  must outlive this.
  explicit MappedSurface(const std::vector<InterestPoint>& points);

  /// @returns by interest point, whether one of the hits is within kNear of it.
  std::vector<bool> shown_by(std::span<const Eigen::Vector3f> hits_W) const;

 private:
  static std::uint64_t cell_of(const Eigen::Vector3i& cell);

  const std::vector<InterestPoint>& points_;
  /// By cell of kNear: points that are within kNear of it. Only ever looked up.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> near_;
};

}  // namespace skein::sim
