// Flies one UAV as a hand wants it: a velocity along and across its heading, a turn, until something else is wanted.
//
// The velocity becomes a path straight ahead that is laid out anew in each exchange, longer than the UAV needs to
// brake. The tracker follows it within the vehicle's limits, and the flight core's safety filter lets it go only so far
// as it may come to rest: in front of an obstacle it stops, and stays there. An explorer flies no faster than its LiDAR
// proves what lies ahead. Without the filter only the vehicle's limits count.
// Frames: W world (ENU), B body.   Units: SI and radians.   Threads: one.   Deterministic.
#pragma once

#include <optional>

#include "core/hand_command.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"
#include "uav_agent/flight_core/sight.hpp"
#include "uav_agent/flight_core/tracker.hpp"
#include "uav_agent/planners/hand/config.hpp"

namespace skein::agent {

class HandFlight {
 public:
  /// @param config, agent  must outlive this.
  HandFlight(const HandConfig& config, const AgentConfig& agent);
  HandFlight(const HandFlight&) = delete;  // parts refer to each other
  HandFlight& operator=(const HandFlight&) = delete;

  /// One exchange. @returns nullopt as long as nobody has wanted it to fly.
  std::optional<TrajectoryCommand> fly(const HandCommand& wanted, const PlannerInput& in);
  /// Why it is slower than it was wanted in the last exchange, by half at least.
  HeldBack held_back() const { return held_back_; }
  /// Where it is about to fly; nullopt: it stays.
  const std::optional<Vector3d>& going_to_W() const { return going_to_W_; }

 private:
  Vector3d wanted_velocity_W(const HandCommand& wanted, const PlannerInput& in);
  double pace_mps(const Vector3d& v_W, const PlannerInput& in) const;
  HeldBack why_slower(double wanted_mps, double pace_mps) const;

  const HandConfig& config_;
  const AgentConfig& agent_;
  Tracker tracker_;
  SafetyFilter filter_;
  OwnSight sight_;
  ToldSpace told_;
  std::optional<Vector3d> going_to_W_;
  HeldBack held_back_ = HeldBack::no;
  bool began_ = false;
  bool low_ = false;  ///< part of what is wanted is left out, for it is too low
};

}  // namespace skein::agent
