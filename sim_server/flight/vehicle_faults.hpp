// Effects of faults on the vehicles themselves: sensors, rotors, battery, wind and commands. Faults of links and
// processes are elsewhere (comm_router/link_stages.hpp, fault_node.hpp). Pure.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/types.hpp"
#include "sim_server/flight/attitude_control.hpp"

namespace skein::sim {

/// Condition of one UAV in an exchange.
struct VehicleCondition {
  bool lidar_works = true, camera_works = true, gimbal_works = true;
  bool odometry_frozen = false;
  Vector3d odometry_offset_m = Vector3d::Zero();  ///< in W
  std::array<double, kRotors> rotor_shares;       ///< share of its thrust and torque that each rotor gives, [0, 1]
  Vector3d gust_W = Vector3d::Zero();             ///< added to the wind at the UAV [m/s]
  bool fix_lost = false;                          ///< no position fix
  double most_charge = 1.0;                       ///< upper limit of the battery's charge, as a share of its capacity
  Tick charge_lost = 0;                           ///< when the fault with this limit began; 0 if there is none
  int command_delay = 0;                          ///< exchanges, in addition to the UAV's own latency

  VehicleCondition() { rotor_shares.fill(1.0); }
};

/// @param uavs  names in fleet order.
/// @returns the condition of each UAV in the exchange that begins at `tick`. Effects do not add up: the plan's reader
///          refuses overlapping faults of the same thing, such as two command delays of one UAV.
std::vector<VehicleCondition> vehicle_conditions(const FaultPlan& plan, const std::vector<std::string>& uavs,
                                                 Tick tick);

}  // namespace skein::sim
