// Where a UAV of XXH waits: at a post of its own beside the entry of a region while its team is not ready, and above
// its start when all is done.
// Frame W.   Units: SI.   Threads: one.
// Source: paper, "Exploration Strategy" of Team XXH, for waiting at the entry, in line of sight of the explorer; how
// the posts lie is our choice.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/xxh/errand.hpp"

namespace skein::agent {

class XxhPost {
 public:
  /// `agent` must outlive this.
  explicit XxhPost(const AgentConfig& agent) : agent_(agent) {}

  /// For another stage of the work: chooses its post anew.
  void leave() { post_W_.reset(); }
  /// It has been at the post that it stays at.
  bool reached() const { return post_W_.has_value(); }
  /// Once per exchange while it waits.
  /// @param places_W  posts to choose from, what is liked best first; where none is free, it waits where it is.
  void stay(const std::vector<Vector3d>& places_W, double speed_mps, XxhErrand& errand, const PlannerInput& in,
            PlannerOutput& out);

  /// Posts of the member `rank` beside the entry of a region: each at a distance of its own; where something is in the
  /// way, higher.
  /// @param centre_W  of the region.   @param top_m  of the site.
  std::vector<Vector3d> beside(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank, double top_m) const;
  /// Above its start, each UAV at a height of its own.
  std::vector<Vector3d> at_home() const;

 private:
  const AgentConfig& agent_;
  std::optional<Vector3d> post_W_;  ///< it has been there
  bool to_post_ = false;            ///< it has set out for one, and does not just wait where it is
  Tick not_before_ = 0;
};

/// Posts from which most of the explorer's places are in sight, as far as map and boxes tell, come first.
void sort_by_sight(const std::vector<Vector3d>& explorer_W, const FreeSpace& space, std::vector<Vector3d>& posts_W);

}  // namespace skein::agent
