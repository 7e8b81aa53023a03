// What the on-board software of one UAV knows before the flight: the rules of the mission, its own vehicle and the
// fleet. It deliberately does not know the scene or the interest points: the UAV must discover these.
// Frame W (world, ENU).   Units: SI and radians unless the name says otherwise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"

namespace skein::agent {

struct FleetMember {
  std::string name;
  Role role = Role::explorer;
  Vector3d p_WB_start = Vector3d::Zero();  ///< nominal, on the ground (z = 0); the true start may be decimetres off
  double body_radius_m = 0.63;             ///< of a sphere about Bo that contains the whole UAV; vehicle
  double max_speed_mps = 6.0;              ///< vehicle
};

struct AgentConfig {
  UavIndex self = {};                 ///< index of this UAV in `fleet`
  std::vector<FleetMember> fleet;     ///< in fleet order, the same on every UAV
  VehicleConfig vehicle;              ///< of this UAV; its LiDAR with the noise and losses of the scenario's conditions
  double desired_mm_per_pixel = 2.0;  ///< resolution on the surface that loses no score; chosen
  double duration_s = 600.0;          ///< of the mission; chosen
  double exchange_period_s = 0.05;    ///< chosen
  Vector3d station_position = Vector3d::Zero();  ///< of the ground station, in W
  BatteryConditions battery;                     ///< of this UAV
  OdometryConditions odometry;                   ///< error model of the odometry, the same for all UAVs
  bool lidar_clutter = false;                    ///< rain or dust may return beams of the LiDARs

  const FleetMember& me() const { return fleet.at(self); }
  /// Index of the first UAV of the fleet with a LiDAR; nullopt: no UAV has one, so no space is ever proved free.
  std::optional<std::size_t> first_explorer() const;
  /// Whether a task with the period `every_s` [s], rounded to exchanges, is due in exchange k. `offset` [exchanges]
  /// shifts it: with another offset on each UAV, such as its index, not all UAVs do the task in the same exchange.
  bool due(std::uint64_t k, double every_s, std::size_t offset) const {
    return (k + offset) % static_cast<std::uint64_t>(std::max(1L, std::lround(every_s / exchange_period_s))) == 0;
  }
};

/// Radius of the sphere about Bo that contains the rotors and the boxes of all parts [m].
double body_radius_m(const VehicleConfig& vehicle);

/// The part of a scenario that the UAV with index `self` may know.
/// @throws std::out_of_range when there is no such UAV.
AgentConfig agent_config(const Scenario& scenario, UavIndex self);

}  // namespace skein::agent
