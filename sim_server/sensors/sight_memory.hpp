// Speeds up trace_link() between two radio nodes: remembers which triangle blocked each sight line last time. Mostly
// the same triangle still blocks it a moment later, and to test one triangle costs far less than to trace a ray.
// Frame W.   Units: m.   Threads: one.
#pragma once

#include <array>

#include "sight/ray_scene.hpp"
#include "sim_server/sensors/antenna_link.hpp"

namespace skein::sim {

/// The memory of one pair of nodes. It affects only the computing time: the results are the same as without it.
class SightMemory {
 public:
  SightMemory() { blockers_.fill(kNoTriangle); }

  /// Whether the two nodes are linked: same result as trace_link() with a ray for each sight line.
  /// @param filter  `among` must have all UAVs that can block a sight line, as BodySpheres::about() returns them.
  bool linked(const AntennaNode& from, const AntennaNode& to, const RayScene& world, const RayFilter& filter) {
    std::size_t line = 0;
    return trace_link(
               from, to,
               [&](const Vector3d& a, const Vector3d& b) { return first_hit(blockers_[line++], a, b, world, filter); })
        .linked;
  }

 private:
  /// @returns distance of an obstacle from `a`. If a remembered triangle surely blocks the line, this is 0.
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
  std::uint32_t last_ = kNoTriangle;  ///< the last blocker of any of the sight lines
};

}  // namespace skein::sim
