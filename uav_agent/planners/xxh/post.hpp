// Where a UAV of XXH waits: at a post of its own beside the entry of a region while its team is not ready, and above
// its start after the last region.
// Frame W.   Units: SI.   Threads: one.
// Source: paper, "Exploration Strategy" of Team XXH, for waiting at the entry, in line of sight of the explorer; the
// positions of the posts are our choice.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/planners/xxh/errand.hpp"

namespace skein::agent {

class XxhPost {
 public:
  /// @param agent  must outlive this.
  explicit XxhPost(const AgentConfig& agent) : agent_(agent) {}

  /// For another stage of the work: the next stay() chooses a post again.
  void leave() { post_W_.reset(); }
  /// Whether the UAV has reached the post that it stays at.
  bool reached() const { return post_W_.has_value(); }
  /// Call it once per exchange while the UAV waits.
  /// @param places_W  posts to choose from, best first; if none is free, the UAV waits where it is.
  void stay(const std::vector<Vector3d>& places_W, double speed_mps, XxhErrand& errand, const PlannerInput& in,
            PlannerOutput& out);

  /// Posts of the member `rank` beside the entry of a region, one above the other, lowest first. Each rank has its own
  /// distance from the entry.
  /// @param centre_W  of the region.   @param top_m  height of the site's top.
  std::vector<Vector3d> beside(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank, double top_m) const;
  /// A post above the UAV's start; each UAV has its own height.
  std::vector<Vector3d> at_home() const;

 private:
  const AgentConfig& agent_;
  std::optional<Vector3d> post_W_;  ///< the post that it has reached
  bool to_post_ = false;            ///< the current choices are posts, and not the place where it is
  Tick not_before_ = 0;
};

/// Sorts posts by how many of the explorer's places they see, as far as map and boxes tell, most first.
void sort_by_sight(const std::vector<Vector3d>& explorer_W, const FreeSpace& space, std::vector<Vector3d>& posts_W);

}  // namespace skein::agent
