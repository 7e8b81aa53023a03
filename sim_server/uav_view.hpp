// One UAV of the simulation, for the rest of the server to read.
// Frames: W world (ENU), B body (FLU).  Units: SI, radians; times are ticks.   Plain data.
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"
#include "sim_server/conditions/surroundings.hpp"

namespace skein::sim {

/// State of one UAV at the step boundary.
struct UavView {
  RigidBodyState state;
  RigidBodyState told;  ///< as its software and its neighbours get it: with errors, latency and faults of odometry
  Tick told_tick = 0;   ///< time stamp of `told`
  PoseUncertainty uncertainty;           ///< of `told`
  std::optional<BatteryStatus> battery;  ///< nullopt: the scenario has no batteries
  BatteryUse battery_use;
  std::optional<Vector3d> wind_W;  ///< [m/s] as the UAV estimates it; nullopt: the scenario has no wind
  GimbalState gimbal;
  bool alive = true;
  bool airborne = false;
  double distance_m = 0.0;  ///< flown
  double max_speed_mps = 0.0;
  double idle_s = 0.0;         ///< time in which it was slow and no capture raised a score for 5 s; see simulation.cpp
  std::uint64_t captures = 0;  ///< exposures that saw at least one point
  std::uint64_t commands_rejected = 0;
  std::optional<Tick> first_rejected;         ///< when the first rejected command was given
  std::optional<TrajectoryCommand> setpoint;  ///< accepted for the exchange that ends here
  int command_latency = 0;                    ///< additional exchanges until a command that is given now takes effect
};

}  // namespace skein::sim
