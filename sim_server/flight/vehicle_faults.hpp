// What a fault file does to the vehicles themselves: sensors, rotors and commands. Links and processes fail elsewhere
// (comm_router/link_stages.hpp, sim_node.hpp). Pure.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/types.hpp"
#include "sim_server/flight/attitude_control.hpp"

namespace skein::sim {

/// How one UAV is in an exchange.
struct VehicleCondition {
  bool lidar_works = true, camera_works = true, gimbal_works = true;
  bool odometry_frozen = false;
  Vector3d odometry_offset_m = Vector3d::Zero();  ///< in W
  std::array<double, kRotors> rotor_shares;       ///< of its thrust and torque that each rotor gives, [0, 1]
  Vector3d gust_W = Vector3d::Zero();             ///< that the air about it moves faster [m/s]
  bool fix_lost = false;                          ///< of its position
  double most_charge = 1.0;                       ///< share of the capacity that its battery can have
  int command_delay = 0;                          ///< exchanges, on top of the UAV's own latency

  VehicleCondition() { rotor_shares.fill(1.0); }
};

/// @param uavs  names in fleet order.
/// @returns the condition of each UAV in the exchange that begins at `tick`. Delays of one UAV do not add up: the
///          plan's reader refuses two at once, as it does for the other faults here.
std::vector<VehicleCondition> vehicle_conditions(const FaultPlan& plan, const std::vector<std::string>& uavs,
                                                 Tick tick);

}  // namespace skein::sim
