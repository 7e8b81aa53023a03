#include "uav_agent/api/agent_config.hpp"

#include <algorithm>
#include <cmath>

#include "core/vehicle/airframe.hpp"

namespace skein::agent {

double body_radius_m(const VehicleConfig& vehicle) {
  const double rotors = vehicle.arm_m + vehicle.rotor_radius_m;
  return std::max(rotors, box_reach(vehicle));
}

std::optional<std::size_t> AgentConfig::first_explorer() const {
  const auto it = std::ranges::find(fleet, Role::explorer, &FleetMember::role);
  if (it == fleet.end()) return std::nullopt;
  return static_cast<std::size_t>(it - fleet.begin());
}

namespace {

/// A UAV knows the conditions of the scenario: the greatest noise of its LiDAR, and that some returns are lost.
void know_conditions(const LidarConditions& conditions, LidarConfig& lidar) {
  constexpr double kWeakReturns = 0.1;  ///< assumed share of lost returns where they may be too weak; chosen
  lidar.sigma_m = std::hypot(lidar.sigma_m, lidar_sigma_m(conditions, lidar.range_max_m, kMostTanIncidence));
  if (conditions.reflectivity) lidar.no_return_p = std::max(lidar.no_return_p, kWeakReturns);
}

}  // namespace

AgentConfig agent_config(const Scenario& scenario, UavIndex self) {
  AgentConfig config;
  config.self = self;
  config.vehicle = scenario.fleet.at(self).vehicle;
  for (const UavConfig& uav : scenario.fleet) {
    config.fleet.push_back({uav.name, uav.vehicle.role, Vector3d(uav.start.x(), uav.start.y(), 0.0),
                            body_radius_m(uav.vehicle), uav.vehicle.max_speed_mps});
  }
  config.desired_mm_per_pixel = scenario.desired_mm_per_pixel;
  config.duration_s = scenario.duration_s;
  config.exchange_period_s = scenario.exchange_period_s;
  config.station_position = scenario.station_position;
  if (config.vehicle.lidar) know_conditions(scenario.conditions.lidar, *config.vehicle.lidar);
  config.lidar_clutter = scenario.conditions.lidar.clutter_p > 0.0;
  config.battery = scenario.conditions.battery;
  config.odometry = scenario.conditions.odometry;
  return config;
}

}  // namespace skein::agent
