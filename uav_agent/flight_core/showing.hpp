// An explorer shows photographers, which have no LiDAR, a way up. It hovers beside the start of a mate that has not
// risen yet, until its map proves the column above that start free, or for FlightConfig::look_s. Map sharing tells the
// mate (onboard/map_radio.hpp). The explorer that starts nearest to a photographer is in charge of it.
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

  /// Chooses the nearest mate that needs to be shown its way. @returns a goal beside its start; nullopt: none.
  std::optional<Goal> next(const PlannerInput& in, const FreeSpace& space);
  /// Whether the column above the mate() is proved free, or the mate has risen.
  bool shown(const PlannerInput& in) const;
  /// Index in the fleet of the mate that next() chose last.
  std::size_t mate() const { return mate_; }

 private:
  /// A photographer that this UAV has to show its way.
  struct Charge {
    std::size_t uav = 0;
    int attempts = 0;
    Tick not_before = 0;
  };
  bool has_risen(std::size_t uav, const PlannerInput& in) const;
  bool column_known(std::size_t uav, const WorldMap& map) const;

  const AgentConfig& agent_;
  const SafetyFilter& filter_;
  std::vector<Charge> charges_;
  std::size_t mate_ = 0;
};

}  // namespace skein::agent
