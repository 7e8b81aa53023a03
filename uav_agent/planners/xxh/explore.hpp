// The exploration of XXH: an explorer's way along the spiral around a section of a region, the camera inwards.
// Frame W.   Units: SI.   Threads: one.
// Source: paper, "Exploration Strategy" of Team XXH. Our choice: places in other boxes or in structure are brought
// farther out or left out; what cannot be reached is tried once more at the end; a section that is seen to hold nothing
// is not flown around.
#pragma once

#include <deque>
#include <vector>

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/errand.hpp"
#include "uav_agent/planners/xxh/region.hpp"

namespace skein::agent {

class XxhExplorer {
 public:
  /// Must outlive this.
  explicit XxhExplorer(const XxhConfig& config) : config_(config) {}

  /// @param at_most_s  to be spent on this section.
  void begin(const XxhRegionMap& region, const XxhRegionMap::Section& section, double at_most_s,
             const PlannerInput& in);
  void stop();
  /// No time is left for this section.
  bool late(const PlannerInput& in) const { return *config_.time_share > 0.0 && in.tick > until_; }
  /// Been everywhere, or no time is left. Who came to no place at all begins again for a while.
  bool finished(const XxhRegionMap& region, const PlannerInput& in);

  /// Once per exchange: turns the camera inwards, and takes note of what was passed.
  void look_inwards(const XxhRegionMap& region, const PlannerInput& in, PlannerOutput& out);
  /// Likewise: hears what became of the choices that it gave.
  void hear(const XxhErrand& errand);
  /// Ways along the places that are left: the first one from the next place on, the others from those after it.
  std::vector<Goal> choices(const FreeSpace& space);

 private:
  void lay_out(const XxhRegionMap& region, const PlannerInput& in);
  void put_off(const Vector3d& place_W);

  const XxhConfig& config_;
  std::deque<Vector3d> places_;   ///< what is left of the spiral
  std::deque<Vector3d> put_off_;  ///< could not be reached yet
  bool again_ = false;            ///< has begun with those
  bool got_nowhere_ = false;      ///< there were places, and it came to none of them
  bool passed_ = false;           ///< some place, since it set out
  XxhRegionMap::Section section_ = {};
  Tick since_ = 0, until_ = 0;  ///< in this section
};

}  // namespace skein::agent
