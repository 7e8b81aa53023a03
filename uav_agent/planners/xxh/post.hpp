// Where a UAV of XXH waits: at a post of its own beside the entry of a region while its team is not ready, and above
// its start when all is done.
// Frame W.   Units: SI.   Threads: one.   Effort: one search for a way in one call.
// Source: paper, "Exploration Strategy" of Team XXH, for waiting at the entry; how the posts lie is our choice.
#pragma once

#include "uav_agent/planners/xxh/ways.hpp"

namespace skein::agent {

class XxhPost {
 public:
  /// All must outlive this.
  XxhPost(const XxhConfig& config, const AgentConfig& agent, XxhWays& ways)
      : config_(config), agent_(agent), ways_(ways) {}

  /// It is at its post or on the way there.
  bool taken() const { return taken_; }
  /// It is called away; next time it tries the same post first.
  void leave() { taken_ = false; }
  /// Likewise, for another stage of the work: it begins with the lowest.
  void leave_for_good();

  /// Sets out for the post of the member `rank`; where something is in the way, a higher one is tried next time.
  /// @param centre_W  of the region.   @returns false if there is no way just now.
  bool take_beside(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank, const PlannerInput& in,
                   PlannerOutput& out);
  /// Likewise for a place above its start, each UAV at a height of its own.
  bool take_at_home(const PlannerInput& in, PlannerOutput& out);

 private:
  std::vector<Vector3d> places(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank) const;

  const XxhConfig& config_;
  const AgentConfig& agent_;
  XxhWays& ways_;
  bool taken_ = false;
  std::size_t choice_ = 0;  ///< among the places
};

}  // namespace skein::agent
