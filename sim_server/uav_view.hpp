// One UAV of the simulation as others may look at it.
// Frames: W world (ENU), B body (FLU).  Units: SI, radians; times are ticks.
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"
#include "sim_server/conditions/surroundings.hpp"

namespace skein::sim {

/// One UAV as it stands at the step boundary.
struct UavView {
  RigidBodyState state;
  RigidBodyState told;  ///< what its software, and its neighbours, hear of that: the same unless its odometry fails
  Tick told_tick = 0;   ///< when that was so
  PoseUncertainty uncertainty;           ///< of `told`
  std::optional<BatteryStatus> battery;  ///< nullopt: this world has none
  BatteryUse battery_use;
  std::optional<Vector3d> wind_W;  ///< as the UAV estimates it; nullopt: there is none
  GimbalState gimbal;
  bool alive = true;
  bool airborne = false;
  double distance_m = 0.0;  ///< flown
  double max_speed_mps = 0.0;
  double idle_s = 0.0;         ///< slow, and no capture raised a score for 5 s; see simulation.cpp
  std::uint64_t captures = 0;  ///< exposures that saw at least one point
  std::uint64_t commands_rejected = 0;
  std::optional<Tick> first_rejected;         ///< when the first of them was given
  std::optional<TrajectoryCommand> setpoint;  ///< accepted for the exchange that ends here
  int command_latency = 0;                    ///< exchanges by which what is commanded now takes effect late
};

}  // namespace skein::sim
