// Return-to-link: decides when a UAV must fly to a place in direct line of sight of the station to deliver captures,
// and to which place. The first choice is where it last had a link, because that is often the nearest such place.
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

  /// Notes the link to the station, and whether captures arrive. Call it once per exchange.
  void update(const PlannerInput& in) { link_.update(in); }
  /// Whether the UAV must fly to a link now. Either the remaining time is only just enough for the flight, and captures
  /// do not arrive from here; or captures have been undelivered for longer than deliver_every_s, and no flight to a
  /// link has been given up in this time.
  bool due(const PlannerInput& in) const;
  /// Call it when none of the places() has a link, or can be reached: the station may be out of reach for long.
  void give_up(const PlannerInput& in) { given_up_ = in.tick; }
  /// Whether the UAV is linked, all its captures are delivered, and there is enough time to work on.
  bool done(const PlannerInput& in) const;
  /// Whether captures are delivered from where the UAV is (LinkWatch::delivers_here()).
  bool delivers_here(const PlannerInput& in) const { return link_.delivers_here(in); }
  /// Places to try (p_WB), best first: where the UAV last had a link, places with a line of sight to the station as far
  /// as is known, and one above the station and all boxes.
  std::vector<Vector3d> places(const PlannerInput& in, const FreeSpace& space) const;

 private:
  /// Estimated time of the flight to a link [s].
  double way_home_s(const PlannerInput& in) const;

  const FlightConfig& config_;
  const AgentConfig& agent_;
  LinkWatch link_;
  std::optional<Tick> given_up_;
};

}  // namespace skein::agent
