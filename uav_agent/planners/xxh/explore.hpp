// The exploration of XXH: an explorer's way along the spiral around a section of a region, the camera inwards.
// Frame W.   Units: SI.   Threads: one.   Effort: a few searches for a way in one exchange.
// Source: paper, "Exploration Strategy" of Team XXH. Our choice: places in other boxes or in structure are brought
// farther out or left out; what is low is looked at from above first, since only space that was seen may be entered
// there; what cannot be reached is tried once more at the end; a section that is seen to hold nothing is not flown
// around.
#pragma once

#include <deque>
#include <optional>

#include "uav_agent/planners/xxh/region.hpp"
#include "uav_agent/planners/xxh/ways.hpp"

namespace skein::agent {

class XxhExplorer {
 public:
  /// Both must outlive this.
  XxhExplorer(const XxhConfig& config, XxhWays& ways) : config_(config), ways_(ways) {}

  /// @param at_most_s  to be spent on this section.
  void begin(const XxhRegionMap& region, const XxhRegionMap::Section& section, double at_most_s,
             const PlannerInput& in);
  void stop();
  /// Been everywhere, or no time is left. Who came to no place at all begins again for a while.
  bool finished(const XxhRegionMap& region, const PlannerInput& in);

  /// Once per exchange: turns camera and body inwards, and takes note of what was passed.
  void look_inwards(const XxhRegionMap& region, const PlannerInput& in, PlannerOutput& out);
  /// When it is at rest, with places left: sets out. @returns false if nothing could be reached just now.
  bool set_out(const PlannerInput& in, PlannerOutput& out);
  /// The way there came to nothing.
  void give_up();

 private:
  void lay_out(const XxhRegionMap& region, const PlannerInput& in);
  bool look_from_above(const Vector3d& place_W, const PlannerInput& in, PlannerOutput& out);

  const XxhConfig& config_;
  XxhWays& ways_;
  std::deque<Vector3d> places_;   ///< what is left of the spiral
  std::deque<Vector3d> put_off_;  ///< could not be reached yet
  bool again_ = false;            ///< has begun with those
  bool got_nowhere_ = false;      ///< there were places, and it came to none of them
  XxhRegionMap::Section section_ = {};
  Tick since_ = 0, until_ = 0;              ///< in this section
  std::optional<Vector3d> looked_down_at_;  ///< the last place that was looked at from above
};

}  // namespace skein::agent
