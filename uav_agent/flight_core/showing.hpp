// An explorer shows photographers, which have no LiDAR, the way up. It hovers beside a photographer that has not risen
// yet, until its map proves that the column above that photographer is free, or until FlightConfig::look_s has passed.
// Map sharing tells the photographer (onboard/map_radio.hpp). If a photographer stays low for long although the column
// is proved free, it may have received no map, because it is out of sight: the explorer hovers beside it again.
//
// Each photographer is the charge of the explorer that starts nearest to it. This explorer may be lost: so an explorer
// that starts farther away takes over after a while, if it sees the photographer stand at its start.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

class Showing {
 public:
  /// @param agent, filter  must outlive this.
  Showing(const AgentConfig& agent, const SafetyFilter& filter);

  /// Chooses the nearest charge that needs to be shown the way up. @returns a goal beside it; nullopt: none.
  std::optional<Goal> next(const PlannerInput& in, const FreeSpace& space);
  /// Whether mate() has risen, or the column above it has been proved free since next() chose it.
  bool shown(const PlannerInput& in) const;
  /// Index in the fleet of the photographer that next() chose last.
  std::size_t mate() const { return mate_; }

 private:
  /// A photographer to which this UAV has to show the way up.
  struct Charge {
    std::size_t uav = 0;
    int nearer = 0;       ///< number of explorers that start nearer to it than this UAV
    int attempts = 0;     ///< goals that next() returned for it
    Tick not_before = 0;  ///< earliest time of the next attempt
  };
  static bool is_visible(std::size_t uav, const PlannerInput& in);
  bool has_risen(std::size_t uav, const PlannerInput& in) const;
  /// Whether it is this UAV's turn to show the way up to this charge, which has not risen yet.
  bool is_due(const Charge& charge, const PlannerInput& in) const;
  /// The place where the UAV was last seen, if it went aside before it climbed; else its start.
  Vector3d place_W(std::size_t uav, const PlannerInput& in) const;
  bool column_known(std::size_t uav, const PlannerInput& in) const;

  const AgentConfig& agent_;
  const SafetyFilter& filter_;
  std::vector<Charge> charges_;
  std::optional<Tick> since_;  ///< time of the first next()
  std::size_t mate_ = 0;
  bool was_known_ = false;  ///< whether the column above mate() was proved free before next() chose it
};

}  // namespace skein::agent
