// One UAV's battery: cells in series with an open-circuit voltage that falls with the charge, behind one resistance.
// Power P at the terminals needs the current I with V(charge) I - R I^2 = P; the pack heats itself with R I^2.
// Units: SI; charge in ampere hours where the name says so.  Pure; threads: one.
#pragma once

#include <algorithm>
#include <array>

#include "core/conditions.hpp"
#include "core/scenario.hpp"
#include "core/told_state.hpp"
#include "core/vehicle/airframe.hpp"

namespace skein::sim {

class Battery {
 public:
  /// A full one, of a size that lets the vehicle hover in still air for `endurance_missions` missions.
  Battery(const BatteryConditions& config, const VehicleConfig& vehicle, double mission_s);

  /// Power at its terminals for some time. What an empty battery cannot give, it does not.
  void draw(double power_w, double time_s);

  /// Loses the charge above a share of the capacity, if it has more.
  void limit(double charge) { left_as_ = std::min(left_as_, charge * capacity_as_); }

  bool empty() const { return left_as_ <= 0.0; }
  double charge() const { return left_as_ / capacity_as_; }
  BatteryStatus status() const;
  /// Of the cells without load, at the present charge [V].
  double open_voltage_v() const;

  double capacity_wh() const;
  /// Given at the terminals so far, turned into heat inside, and left in the cells [J].
  double given_j() const { return given_j_; }
  double heat_j() const { return heat_j_; }
  double left_j() const;
  double time_s() const { return time_s_; }  ///< for which it was drawn from

 private:
  double energy_j(double left_as) const;

  int cells_;
  double resistance_ohm_ = 0.0;
  double capacity_as_ = 0.0, left_as_ = 0.0;  ///< [A s]
  double current_a_ = 0.0, given_j_ = 0.0, heat_j_ = 0.0, time_s_ = 0.0;
};

/// What a vehicle's rotors and electronics need [W]: ideal power by momentum theory, over the efficiency.
/// @param thrusts_n  of the rotors.  @param v_A_B  of the body through the air, in its own axes.
double electric_power(const BatteryConditions& config, const VehicleConfig& vehicle,
                      const std::array<double, kRotors>& thrusts_n, const Vector3d& v_A_B);

}  // namespace skein::sim
