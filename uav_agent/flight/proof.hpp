// How many rays must have passed a place that may only be entered where it was seen to be free: one ladder for all
// planners, as it was measured (docs/decisions/). Who cannot get anywhere goes a rung down; when, and for how long, is
// the planner's to say.
// Threads: one.
#pragma once

#include <algorithm>
#include <array>

#include "core/types.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

class Proof {
 public:
  static constexpr std::size_t kLast = 3;  ///< rung

  /// @param roomy  the site has a box that is too large to be one piece of structure (site.hpp): what is thin in it
  /// takes many rays to be found.
  static int rays(bool roomy) { return roomy ? kRoomyRays : kProofRays; }
  /// So many rungs further down than so many rays, but never next to nothing. Who has no LiDAR does not see at the last
  /// moment what these rays have missed, and asks for more.
  static int of(int rays, std::size_t rung, Role role) {
    const int few = role != Role::explorer ? kLeastUnseeingRays : rays > kProofRays ? kLeastRoomyRays : kLeastRays;
    return std::max(std::min(rays, few), rays * kRungs[std::min(rung, kLast)] / kRungs.front());
  }
  int of(int rays, Role role) const { return of(rays, rung_, role); }
  void ask_less() { rung_ = std::min(rung_ + 1, kLast); }
  /// Until then, or until it asks for less again.
  void ask_less(Tick until) {
    ask_less();
    until_ = until;
  }
  /// All of it again, if its time is over.
  void settle(Tick now) {
    if (now >= until_) ask_all();
  }
  void ask_all() { rung_ = 0; }

 private:
  static constexpr int kRoomyRays = 16, kLeastRoomyRays = 8, kLeastRays = 6, kLeastUnseeingRays = 9;
  static constexpr std::array<int, kLast + 1> kRungs = {12, 9, 6, 6};

  std::size_t rung_ = 0;
  Tick until_ = 0;
};

}  // namespace skein::agent
