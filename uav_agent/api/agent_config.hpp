// What one UAV's on-board software knows before it flies: the rules of the game, its own vehicle, who else flies.
// Deliberately not the scene and not the interest points: those are for the UAV to find out.
// Frame W (world, ENU).   Units: SI and radians unless the name says otherwise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario.hpp"

namespace skein::agent {

struct FleetMember {
  std::string name;
  Role role = Role::explorer;
  Vector3d p_WB_start = Vector3d::Zero();  ///< nominal place on the ground; the real one may be off by decimetres
  double body_radius_m = 0.63;             ///< sphere around the body's origin that holds the whole UAV
  double max_speed_mps = 6.0;
};

struct AgentConfig {
  UavIndex self = {};              ///< index into fleet
  std::vector<FleetMember> fleet;  ///< in fleet order, the same on every UAV
  VehicleConfig vehicle;           ///< its own
  double desired_mm_per_pixel = 2.0;
  double duration_s = 600.0;
  double exchange_period_s = 0.05;
  Vector3d station_position = Vector3d::Zero();
  BatteryConditions battery;    ///< of its own vehicle
  OdometryConditions odometry;  ///< how far odometry errs here, its own and its mates'

  const FleetMember& me() const { return fleet.at(self); }
  /// The first of the fleet that has a LiDAR; none: nobody ever sees what is free.
  std::optional<std::size_t> first_explorer() const;
  /// Whether something that is done every `every_s` falls into exchange k; whoever has another `offset` does it in
  /// another one, so that not all do it at once.
  bool due(std::uint64_t k, double every_s, std::size_t offset) const {
    return (k + offset) % static_cast<std::uint64_t>(std::max(1.0, every_s / exchange_period_s)) == 0;
  }
};

/// Radius of the sphere around the body's origin that holds arms, rotors and camera [m].
double body_radius_m(const VehicleConfig& vehicle);

/// The part of a scenario that UAV `self` (in fleet order) may know.
/// @throws std::out_of_range when there is no such UAV.
AgentConfig agent_config(const Scenario& scenario, UavIndex self);

}  // namespace skein::agent
