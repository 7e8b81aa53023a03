// The exploration of XXH: flies an explorer along the spiral around a section of a region, with the camera inwards.
// Frame W.   Units: SI.   Threads: one.
// Source: paper, "Exploration Strategy" of Team XXH. Our choice: places in other boxes or in structure are moved
// outwards or left out; a place that cannot be reached is tried once more at the end; a section that the map shows to
// be empty is left out.
#pragma once

#include <deque>
#include <vector>

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/errand.hpp"
#include "uav_agent/planners/xxh/region.hpp"

namespace skein::agent {

class XxhExplorer {
 public:
  /// @param config  must outlive this.
  explicit XxhExplorer(const XxhConfig& config) : config_(config) {}

  /// Begins a section.   @param at_most_s  time limit for the section.
  void begin(const XxhRegionMap& region, const XxhRegionMap::Section& section, double at_most_s,
             const PlannerInput& in);
  void stop();
  /// Whether the time limit of the section has passed.
  bool late(const PlannerInput& in) const { return *config_.time_share > 0.0 && in.tick > until_; }
  /// Whether the section is done, or its time has passed. If no place was reached, begins again, for up to retry_s.
  bool finished(const XxhRegionMap& region, const PlannerInput& in);

  /// Turns the camera inwards, and removes places that were passed. Call it once per exchange.
  void look_inwards(const XxhRegionMap& region, const PlannerInput& in, PlannerOutput& out);
  /// Reads the outcomes of the choices that it gave. Call it once per exchange.
  void hear(const XxhErrand& errand);
  /// Goals along the places that are left: the first one begins at the next place, the others at the places after it.
  std::vector<Goal> choices(const FreeSpace& space);

 private:
  void lay_out(const XxhRegionMap& region, const PlannerInput& in);
  void put_off(const Vector3d& place_W);

  const XxhConfig& config_;
  std::deque<Vector3d> places_;   ///< places of the spiral that are left
  std::deque<Vector3d> put_off_;  ///< places that could not be reached yet
  bool again_ = false;            ///< places_ are those that were put off before
  bool got_nowhere_ = false;      ///< there were places, and none was reached
  bool passed_ = false;           ///< a place was passed since the last choices()
  XxhRegionMap::Section section_ = {};
  Tick since_ = 0, until_ = 0;  ///< begin and time limit of this section
};

}  // namespace skein::agent
