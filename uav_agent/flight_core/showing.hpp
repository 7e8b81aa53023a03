// Who has a LiDAR shows those that have none a way up: it hovers beside a mate that has not risen until its map knows
// the column above that one's start, which the radio then tells (onboard/map_radio.hpp).
// Each photographer is shown its way by the explorer that starts nearest.
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

  /// Whom to show a way now, nearest first: a goal beside it. nullopt: nobody.
  std::optional<Goal> next(const PlannerInput& in, const FreeSpace& space);
  /// Whether the one that next() named last has been shown its way, or has risen.
  bool shown(const PlannerInput& in) const;
  std::size_t mate() const { return mate_; }

 private:
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
