// Sight lines between two radio nodes through the world, for trace_link(): remembers what blocked each of them last
// time. What hid one antenna from another mostly still does a moment later, and to see that costs far less than a ray.
// Frame W.   Units: m.
#pragma once

#include <array>

#include "sight/ray_scene.hpp"
#include "sim_server/sensors/antenna_link.hpp"

namespace skein::sim {

/// One for each pair of nodes. Its answers are those of rays alone: only their price depends on what was asked before.
class SightMemory {
 public:
  SightMemory() { blockers_.fill(kNoTriangle); }

  /// As trace_link() with a ray for each sight line.
  /// @param filter  `among` may be those about the two nodes, within the antennas' reach.
  bool linked(const AntennaNode& from, const AntennaNode& to, const RayScene& world, const RayFilter& filter) {
    std::size_t line = 0;
    return trace_link(
               from, to,
               [&](const Vector3d& a, const Vector3d& b) { return first_hit(blockers_[line++], a, b, world, filter); })
        .linked;
  }

 private:
  /// @returns 0, too, where something surely blocks.
  std::optional<double> first_hit(std::uint32_t& blocker, const Vector3d& a, const Vector3d& b, const RayScene& world,
                                  const RayFilter& filter) {
    const double length = (b - a).norm();
    const double before_the_end = length - 2.0 * kEndTolerance;
    for (const std::uint32_t known : {blocker, last_}) {
      if (world.surely_blocked_by(known, a, b, before_the_end)) return 0.0;
    }
    const auto hit = world.first_hit_or_blocker(a, b - a, length, before_the_end, filter);
    blocker = last_ = hit ? hit->triangle : kNoTriangle;
    return hit ? std::optional(hit->distance) : std::nullopt;
  }

  std::array<std::uint32_t, kAntennas * kAntennas> blockers_;
  std::uint32_t last_ = kNoTriangle;  ///< of any of the lines
};

}  // namespace skein::sim
