// Where explorers have flown, as far as this UAV has seen: places that are proved free, near which new work opens.
// Frame W.   Units: SI.   Threads: one.   Deterministic.   Bounded: kMostTrail places.
#pragma once

#include <deque>
#include <optional>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class FlockTrail {
 public:
  static constexpr std::size_t kMostTrail = 60;  ///< chosen

  /// Adds the position of an explorer in line of sight.
  void note(const Vector3d& p_W);
  /// The newest free place at which no other UAV is; nullopt: there is none.
  std::optional<Vector3d> behind_explorer_W(const PlannerInput& in) const;
  /// Whether two such places are so near each other that a flight between them is useless.
  static bool same(const Vector3d& a_W, const Vector3d& b_W);

 private:
  std::deque<Vector3d> places_W_;  ///< oldest first
};

}  // namespace skein::agent
