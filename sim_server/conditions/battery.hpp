// One UAV's battery: cells in series with an open-circuit voltage that falls with the charge, behind one resistance.
// Power P at the terminals needs the current I with V(charge) I - R I^2 = P; the pack heats itself with R I^2.
// Units: SI; charge in ampere hours where the name says so.  Pure; threads: one.
#pragma once

#include <algorithm>
#include <array>

#include "core/messages/uav_status.hpp"
#include "core/scenario/conditions.hpp"
#include "core/scenario/scenario.hpp"
#include "core/vehicle/airframe.hpp"

namespace skein::sim {

class Battery {
 public:
  /// A full battery, with the capacity to hover in still air for `endurance_missions` missions.
  /// @param mission_s  duration of a mission [s].
  Battery(const BatteryConditions& config, const VehicleConfig& vehicle, double mission_s);

  /// Draws power at the terminals for some time. An empty battery gives nothing.
  void draw(double power_w, double time_s);

  /// Puts a full battery in its place.
  void swap() { left_as_ = capacity_as_; }
  /// Limits the charge to a share of the capacity; the charge above it is lost.
  void limit(double charge) { left_as_ = std::min(left_as_, charge * capacity_as_); }

  bool empty() const { return left_as_ <= 0.0; }
  /// Share of the capacity that is left, [0, 1].
  double charge() const { return left_as_ / capacity_as_; }
  BatteryStatus status() const;
  /// Open-circuit voltage of all cells at the present charge [V].
  double open_voltage_v() const;

  double capacity_wh() const;
  /// Energy delivered at the terminals so far, energy turned into heat inside (both also by batteries that were swapped
  /// since), and energy left in the cells [J].
  double given_j() const { return given_j_; }
  double heat_j() const { return heat_j_; }
  double left_j() const;
  double time_s() const { return time_s_; }  ///< total time for which power was drawn

 private:
  double energy_j(double left_as) const;

  int cells_;
  double resistance_ohm_ = 0.0;
  double capacity_as_ = 0.0, left_as_ = 0.0;  ///< [A s]
  double current_a_ = 0.0, given_j_ = 0.0, heat_j_ = 0.0, time_s_ = 0.0;
};

/// Electric power of a vehicle [W]: the rotors' ideal power by momentum theory, over the efficiency, plus electronics.
/// @param thrusts_n  of the rotors.  @param v_A_B  velocity of the body through the air, in B [m/s].
double electric_power(const BatteryConditions& config, const VehicleConfig& vehicle,
                      const std::array<double, kRotors>& thrusts_n, const Vector3d& v_A_B);

}  // namespace skein::sim
