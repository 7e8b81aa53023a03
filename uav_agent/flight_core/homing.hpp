// Return-to-link: decides when a UAV must fly to a place in direct line of sight of the station to deliver captures,
// and to which place. Before the end of the mission, it decides by value (flight/delivery_rule.hpp) if the planner
// states its stake, otherwise by time. The first choice by time and at the end is where the UAV last had a link,
// because that is often the nearest such place; by value, it is the nearest place where the UAV had a link.
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
  /// @param stake  see PlannerOutput::stake.
  void update(const PlannerInput& in, const std::optional<Stake>& stake = {}) {
    link_.update(in);
    stake_ = stake;
  }
  /// Whether the UAV must fly to a link now, because captures do not arrive from here and the remaining time is only
  /// just enough for the flight; or because no flight to a link has been given up for deliver_every_s, and a delivery
  /// pays. Without a stake, it pays when captures have been undelivered for longer than deliver_every_s.
  bool due(const PlannerInput& in) const;
  /// Call it when none of the places() has a link, or can be reached: the station may be out of reach for long.
  void give_up(const PlannerInput& in) { given_up_ = in.tick; }
  /// Whether the UAV is linked, all its captures are delivered, and there is enough time to work on.
  bool done(const PlannerInput& in) const;
  /// Whether captures are delivered from where the UAV is (LinkWatch::delivers_here()).
  bool delivers_here(const PlannerInput& in) const { return link_.delivers_here(in); }
  /// Places to try (p_WB), best first: where the UAV had a link, places with a line of sight to the station as far as
  /// is known, and one above the station and all boxes.
  std::vector<Vector3d> places(const PlannerInput& in, const FreeSpace& space) const;

 private:
  /// Estimated time of the flight to a link [s].
  double way_home_s(const PlannerInput& in) const;
  /// Time until the UAV must return to deliver before the mission's end [s]. Only with mission_remaining_s.
  double left_s(const PlannerInput& in) const {
    return *in.mission_remaining_s - way_home_s(in) - config_.return_margin_s;
  }
  bool pays(const PlannerInput& in) const;

  const FlightConfig& config_;
  const AgentConfig& agent_;
  LinkWatch link_;
  std::optional<Stake> stake_;
  std::optional<Tick> given_up_;
};

}  // namespace skein::agent
