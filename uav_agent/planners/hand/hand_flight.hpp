// Flies one UAV by manual commands: a velocity relative to its heading and a yaw rate, in force until the next command.
//
// In each exchange the velocity becomes a new straight path, longer than the UAV's braking distance. The tracker
// follows the path within the vehicle's limits, and the flight core's safety filter lets the UAV fly only as far as it
// may come to rest: in front of an obstacle it stops and stays there. An explorer flies no faster than its LiDAR proves
// the space ahead. Without the safety filter only the vehicle's limits count.
// Frames: W world (ENU), B body.   Units: SI and radians.   Threads: one.   Deterministic.
#pragma once

#include <optional>

#include "core/messages/hand_command.hpp"
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

  /// Call it once per exchange. @returns nullopt before the first command that makes the UAV fly.
  std::optional<TrajectoryCommand> fly(const HandCommand& wanted, const PlannerInput& in);
  /// Why the UAV flew at no more than half the commanded speed in the last exchange.
  HeldBack held_back() const { return held_back_; }
  /// End of the present path; nullopt: the UAV stays where it is.
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
  bool low_ = false;  ///< part of the command was ignored because the UAV is too low
};

}  // namespace skein::agent
