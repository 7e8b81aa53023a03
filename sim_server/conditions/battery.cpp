#include "sim_server/conditions/battery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vehicle/rotor_power.hpp"

namespace skein::sim {
namespace {

// Open-circuit voltage of a lithium polymer cell, taken to be linear in the charge.
constexpr double kFullCell_v = 4.2, kEmptyCell_v = 3.5;
constexpr double kMeanCell_v = 0.5 * (kFullCell_v + kEmptyCell_v);
constexpr double kSecondsPerHour = 3600.0;

}  // namespace

Battery::Battery(const BatteryConditions& config, const VehicleConfig& vehicle, double mission_s)
    : cells_(config.cells) {
  const double hover_w = hover_power(vehicle, config), mean_v = kMeanCell_v * cells_;
  const double hover_a = hover_w / ((1.0 - config.sag) * mean_v);
  resistance_ohm_ = config.sag * mean_v / hover_a;
  capacity_as_ = left_as_ = hover_a * config.endurance_missions.value_or(1.0) * mission_s;
}

double Battery::open_voltage_v() const { return cells_ * (kEmptyCell_v + (kFullCell_v - kEmptyCell_v) * charge()); }

void Battery::draw(double power_w, double time_s) {
  if (empty()) {
    current_a_ = 0.0;
    return;
  }
  const double open_v = open_voltage_v();
  // The smaller root of the quadratic. There is no root above the battery's maximum power; it then gives that maximum.
  const double root2 = open_v * open_v - 4.0 * resistance_ohm_ * power_w;
  const double wanted_a =
      resistance_ohm_ > 0.0 ? (open_v - std::sqrt(std::max(0.0, root2))) / (2.0 * resistance_ohm_) : power_w / open_v;
  const double before_j = left_j();
  const double taken_as = std::min(left_as_, wanted_a * time_s);
  left_as_ -= taken_as;
  current_a_ = taken_as / time_s;
  const double heat_j = resistance_ohm_ * current_a_ * current_a_ * time_s;
  heat_j_ += heat_j;
  given_j_ += before_j - left_j() - heat_j;
  time_s_ += time_s;
}

double Battery::energy_j(double left_as) const {
  const double charge = left_as / capacity_as_;
  return cells_ * left_as * (kEmptyCell_v + 0.5 * (kFullCell_v - kEmptyCell_v) * charge);
}

double Battery::left_j() const { return energy_j(left_as_); }
double Battery::capacity_wh() const { return energy_j(capacity_as_) / kSecondsPerHour; }

BatteryStatus Battery::status() const {
  return {charge(), capacity_as_ / kSecondsPerHour, open_voltage_v() - resistance_ohm_ * current_a_, current_a_};
}

double electric_power(const BatteryConditions& config, const VehicleConfig& vehicle,
                      const std::array<double, kRotors>& thrusts_n, const Vector3d& v_A_B) {
  const double area_m2 = std::numbers::pi * vehicle.rotor_radius_m * vehicle.rotor_radius_m;
  const double across_mps = v_A_B.head<2>().norm();
  double ideal_w = 0.0;
  for (const double thrust_n : thrusts_n) ideal_w += ideal_power(thrust_n, area_m2, across_mps, v_A_B.z());
  return ideal_w / config.efficiency + config.avionics_w;
}

}  // namespace skein::sim
