// Bringing captures home: when a UAV must leave to be in direct line of sight of the station, and where to. The nearest
// such place is often the one where it last had the link: it comes first.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/link_watch.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

class Homing {
 public:
  /// @param config, agent  must outlive this.
  Homing(const FlightConfig& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Once per exchange: takes note of links and of what has been delivered.
  void update(const PlannerInput& in) { link_.update(in); }
  /// Whether it is time to leave: by the clock, unless captures are delivered from where it is.
  bool due(const PlannerInput& in) const;
  /// All is delivered, and there is time to work on.
  bool done(const PlannerInput& in) const;
  /// It is linked, and what it has arrives: it may stay where it is.
  bool delivers_here(const PlannerInput& in) const { return link_.delivers_here(in); }
  /// Where to go, best first: places from which the station is in sight as far as is known, then above all structure.
  std::vector<Vector3d> places(const PlannerInput& in, const FreeSpace& space) const;

 private:
  double way_home_s(const PlannerInput& in) const;

  const FlightConfig& config_;
  const AgentConfig& agent_;
  LinkWatch link_;
};

}  // namespace skein::agent
