// Making room: a UAV that rests moves away from another UAV that stands close to it, because it may block that UAV. The
// safety filter allows no motion that brings two UAVs nearer to each other: a UAV between a canopy and UAVs below it,
// for example, cannot move. Neither UAV knows where the other wants to fly. But each sees for how long the other has
// stood, so both can apply this rule.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"

namespace skein::agent {

class MakingRoom {
 public:
  /// @param config, agent, filter  must outlive this.
  MakingRoom(const FlightConfig& config, const AgentConfig& agent, SafetyFilter& filter);

  /// Notes for how long the UAVs have stood. Call it once per exchange.
  void update(const PlannerInput& in);
  /// The place to which this UAV's centre should move in a straight line. Call it while the UAV rests.
  /// @returns nullopt if no UAV in sight has stood too close for long enough, or if there is no better place nearby.
  std::optional<Vector3d> place_W(const PlannerInput& in);

 private:
  struct Stand {
    Vector3d p_W = Vector3d::Zero();
    Tick since = 0;
  };

  static void note(const Vector3d& p_W, Tick tick, Stand& stand);
  double room_m(const Vector3d& p_W, const PlannerInput& in) const;
  double room_to_m(const Peer& peer, const Vector3d& p_W) const;

  const FlightConfig& config_;
  const AgentConfig& agent_;
  SafetyFilter& filter_;
  Stand own_;
  std::vector<Stand> others_;  ///< by index in the fleet
};

}  // namespace skein::agent
